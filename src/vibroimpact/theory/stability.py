"""Stability of two impacts per cycle on the fast time scale: what the chapter prints, and what the impact map says."""

import numpy as np

from vibroimpact.theory.manifold import rho

# Above this C symmetric motions lose stability to asymmetric ones, whatever kappa (docs/derivation.md, section 9).
SYMMETRY_BREAKING_C = np.pi**2 / (np.pi**2 - 4)


def printed_limit(rho):
    """C above which a module's motion is stable according to (10.26), as printed: 4 / (4 + pi rho)."""
    return 4 / (4 + np.pi * rho)


def impact_multipliers(C, kappa) -> np.ndarray:
    """Multipliers, shape (2,), of the map from one impact to the next on the manifold, B and phi held.

    Small changes of impact time and ball speed, seen mirrored from impact to impact; stable where both moduli are
    below 1, that is for C_min < C < SYMMETRY_BREAKING_C. Their product is kappa^2, their sum
    2 kappa + pi^2 (1 + kappa)^2 (1 - C) / (4 C).
    """
    if C == 0:
        raise ValueError("C: 0.0 is a grazing motion, which has no linearised impact map")
    slope = 2 / np.pi + rho(kappa)
    time_by_speed = np.pi / (C * slope)
    speed_by_time = (1 + kappa) * (1 - C)
    step = np.array([[kappa, time_by_speed], [kappa * speed_by_time, kappa + time_by_speed * speed_by_time]])
    return np.linalg.eigvals(step)
