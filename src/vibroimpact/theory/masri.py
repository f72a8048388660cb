"""Masri's stability analysis of motions with two impacts per cycle, at constant amplitude B and phase phi of U.

The perturbations are small changes of the impact time and of the ball speed. A linear map takes the perturbations at
one impact to the perturbations at the next impact (docs/stability.md). The determinant of the map is kappa^2. The trace
of the map is 2 kappa + pi^2 (1 + kappa)^2 (1 - C) / (4 C), where C is the saw-tooth amplitude. The eigenvalues of the
map are called multipliers. The motion is stable if both multipliers are inside the unit circle. If C decreases to
C_min, where the arms of the manifold merge, a multiplier reaches +1. If C increases to pi^2 / (pi^2 - 4), where two
asymmetric motions branch off, a multiplier reaches -1. Complex multipliers are always inside the unit circle, since the
determinant is below 1. The printed condition (10.26) differs from this result.
"""

import numpy as np

from vibroimpact.system.verdict import verdict
from vibroimpact.theory.manifold import C_min, rho

ROUNDING = 16 * np.finfo(float).eps
# At this value of C, two asymmetric motions branch off the symmetric motion. At larger C, the symmetric motion
# is unstable.
SYMMETRY_BREAKING_C = np.pi**2 / (np.pi**2 - 4)


def impact_multipliers(C, kappa) -> np.ndarray:
    """Return the eigenvalues of the linear map from one impact to the next, at constant B and phi, shape (2,).

    If C_min < C < SYMMETRY_BREAKING_C, both eigenvalues are below 1 in modulus, and the motion is stable.

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
    """Return the multipliers for one cycle, shape (2,).

    A cycle has two impacts. Therefore the multipliers for one cycle are the squares of `impact_multipliers`.

    Raises
    ------
    ValueError
        If C is 0 (grazing).
    """
    return impact_multipliers(C, kappa) ** 2


def lower_limit(kappa):
    """Return the saw-tooth amplitude C_min at the fold of the manifold, (10.25).

    If 0 < C < C_min, a multiplier is above +1, and the motion is unstable.
    """
    return C_min(rho(kappa))


def upper_limit(kappa):
    """Return pi^2 / (pi^2 - 4) in an array with the shape of kappa, or as a number if kappa is a number.

    If the saw-tooth amplitude C is above this limit, a multiplier is below -1, and the motion is unstable.
    """
    return np.full(np.shape(kappa), SYMMETRY_BREAKING_C)[()]


def stable(C: float, kappa: float, error: float = 0.0) -> str:
    """Return the verdict of Masri's analysis at the saw-tooth amplitude C.

    The verdict is "stable" if C is between `lower_limit` and `upper_limit`, and else "unstable". If the distance of C
    from a limit is at most `error` plus the rounding error, the verdict is "undecided". `error` is an upper bound on
    the error of C.
    """
    margin = min(C - lower_limit(kappa), upper_limit(kappa) - C)
    return verdict(margin, error + ROUNDING * max(1.0, abs(C)))


def printed_limit(rho):
    """Return 4 / (4 + pi rho); a module with a larger C is stable according to (10.26) as printed."""
    return 4 / (4 + np.pi * rho)
