"""Masri's stability analysis of motions with two impacts per cycle, at constant amplitude B and phase phi of U.

A linear map leads from perturbations of impact time and ball speed at one impact to those at the next
(docs/stability.md). Its determinant is kappa^2. Its trace is 2 kappa + pi^2 (1 + kappa)^2 (1 - C) / (4 C), where C is
the saw-tooth amplitude. A multiplier leaves the unit circle through +1 at C_min, where the arms of the manifold merge.
It leaves through -1 at C = pi^2 / (pi^2 - 4), where two asymmetric motions branch off. Complex multipliers stay inside,
since the determinant is below 1. The printed condition (10.26) differs from this result.
"""

import numpy as np

from vibroimpact.system.verdict import verdict
from vibroimpact.theory.manifold import C_min, rho

ROUNDING = 16 * np.finfo(float).eps
# At this C asymmetric motions branch off. The symmetric motion is unstable at larger C.
SYMMETRY_BREAKING_C = np.pi**2 / (np.pi**2 - 4)


def impact_multipliers(C, kappa) -> np.ndarray:
    """Return the multipliers (2,) of perturbations from one impact to the next, at constant B and phi.

    Both are below 1 in modulus for C_min < C < SYMMETRY_BREAKING_C, where the motion is stable.

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
    """Return the multipliers (2,) of perturbations over one cycle, the squares of `impact_multipliers`.

    Raises
    ------
    ValueError
        If C is 0 (grazing).
    """
    return impact_multipliers(C, kappa) ** 2


def lower_limit(kappa):
    """Return C_min of the fold of the manifold, (10.25); for 0 < C < C_min a multiplier is above +1."""
    return C_min(rho(kappa))


def upper_limit(kappa):
    """Return pi^2 / (pi^2 - 4) in the shape of kappa; at larger C a multiplier is below -1."""
    return np.full(np.shape(kappa), SYMMETRY_BREAKING_C)[()]


def stable(C: float, kappa: float, error: float = 0.0) -> str:
    """Return "stable" if C is between both limits, "unstable" outside, or "undecided" within `error` of a limit."""
    margin = min(C - lower_limit(kappa), upper_limit(kappa) - C)
    return verdict(margin, error + ROUNDING * max(1.0, abs(C)))


def printed_limit(rho):
    """Return 4 / (4 + pi rho), the C above which a module is stable according to (10.26) as printed."""
    return 4 / (4 + np.pi * rho)
