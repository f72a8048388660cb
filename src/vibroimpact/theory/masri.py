"""Masri's perturbation analysis of two impacts per cycle at constant B and phi: multipliers, limits, verdict.

The condition that the chapter prints, (10.26), differs: see `printed_limit`.

The derivation is in docs/stability.md. A map takes perturbations of impact time and ball speed from one impact to the
mirror image of the next; its determinant is kappa^2 and its trace 2 kappa + pi^2 (1 + kappa)^2 (1 - C) / (4 C). A
multiplier leaves the unit circle through +1 at C_min, where the two arms of the manifold merge, and through -1 at pi^2
/ (pi^2 - 4), where two asymmetric motions branch off the symmetric one. There is no other case, since the determinant
is below 1.
"""

import numpy as np

from vibroimpact.system.verdict import verdict
from vibroimpact.theory.manifold import C_min, rho

ROUNDING = 16 * np.finfo(float).eps
# Above this C symmetric motions lose stability to asymmetric ones, for every kappa (docs/stability.md).
SYMMETRY_BREAKING_C = np.pi**2 / (np.pi**2 - 4)


def impact_multipliers(C, kappa) -> np.ndarray:
    """Return the multipliers, shape (2,), of the map from one impact to the next at constant B and phi.

    The map applies to perturbations of impact time and ball speed, mirrored from impact to impact. It is stable if both
    moduli are below 1, that is for C_min < C < SYMMETRY_BREAKING_C. Their product is kappa^2, their sum
    2 kappa + pi^2 (1 + kappa)^2 (1 - C) / (4 C).

    Raises
    ------
    ValueError
        If C is 0 (grazing).
    """
    if C == 0:
        raise ValueError("C: must not be 0 (a grazing motion has no linearised impact map)")
    slope = 2 / np.pi + rho(kappa)
    time_by_speed = np.pi / (C * slope)
    speed_by_time = (1 + kappa) * (1 - C)
    step = np.array([[kappa, time_by_speed], [kappa * speed_by_time, kappa + time_by_speed * speed_by_time]])
    return np.linalg.eigvals(step)


def multipliers(C: float, kappa: float) -> np.ndarray:
    """Return the multipliers, shape (2,), of perturbations over one cycle (two impacts) at constant B and phi.

    They are the squares of `impact_multipliers`, since a cycle is twice half a cycle with mirroring. Their product is
    kappa^4.

    Raises
    ------
    ValueError
        If C is 0 (grazing).
    """
    return impact_multipliers(C, kappa) ** 2


def lower_limit(kappa):
    """Return the C below which a multiplier is above +1: the fold C_min of the manifold, (10.25)."""
    return C_min(rho(kappa))


def upper_limit(kappa):
    """Return the C above which a multiplier of the mirrored map is below -1.

    It is pi^2 / (pi^2 - 4) for every kappa, in the shape of kappa.
    """
    return np.full(np.shape(kappa), SYMMETRY_BREAKING_C)[()]


def stable(C: float, kappa: float, error: float = 0.0) -> str:
    """Return the verdict "stable", "unstable" or "undecided": stable if C is between both limits.

    Parameters
    ----------
    C : float
        Saw-tooth amplitude.
    kappa : float
        Restitution coefficient.
    error : float, default 0.0
        Bound on the error of C; rounding is added to it.
    """
    margin = min(C - lower_limit(kappa), upper_limit(kappa) - C)
    return verdict(margin, error + ROUNDING * max(1.0, abs(C)))


def printed_limit(rho):
    """Return the C above which a module's motion is stable according to (10.26), as printed.

    It is 4 / (4 + pi rho), in the shape of rho.
    """
    return 4 / (4 + np.pi * rho)


def limit_with_squares(rho):
    """Return the limit of (10.26) if its squares were lost in print.

    It is 4 / (4 + pi^2 rho^2) = (1 + kappa)^2 / (2 (1 + kappa^2)).
    """
    return 4 / (4 + (np.pi * rho) ** 2)
