"""Masri's stability analysis of motions with two impacts per cycle at constant B and phi: multipliers, limits, verdict.

The condition printed in the chapter, (10.26), differs from the result of this analysis: see `printed_limit`.

The derivation is in docs/stability.md. A linear map leads from the perturbations of impact time and ball speed at an
impact to the perturbations of impact time and ball speed at the next impact. The determinant of the map is kappa^2 and
its trace is 2 kappa + pi^2 (1 + kappa)^2 (1 - C) / (4 C), where C is the saw-tooth amplitude. A multiplier leaves the
unit circle through +1 at C_min, where the two arms of the manifold merge, or through -1 at C = pi^2 / (pi^2 - 4), where
two asymmetric motions branch off the symmetric motion. A pair of complex multipliers cannot leave the unit circle,
since the determinant is below 1.
"""

import numpy as np

from vibroimpact.system.verdict import verdict
from vibroimpact.theory.manifold import C_min, rho

ROUNDING = 16 * np.finfo(float).eps
# At this C asymmetric motions branch off the symmetric motion, which is unstable at larger C (docs/stability.md).
SYMMETRY_BREAKING_C = np.pi**2 / (np.pi**2 - 4)


def impact_multipliers(C, kappa) -> np.ndarray:
    """Return the multipliers, shape (2,), of the map from one impact to the next at constant B and phi.

    The map leads from the perturbations of impact time and ball speed at an impact to the perturbations of impact
    time and ball speed at the next impact. The motion is stable if both multipliers are below 1 in modulus, that is for
    C_min < C < SYMMETRY_BREAKING_C. The product of the multipliers is kappa^2, and their sum is
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

    They are the squares of `impact_multipliers`, since the map over a cycle applies the map between impacts twice.
    Their product is kappa^4.

    Raises
    ------
    ValueError
        If C is 0 (grazing).
    """
    return impact_multipliers(C, kappa) ** 2


def lower_limit(kappa):
    """Return C_min, the value of C at the fold of the manifold, (10.25); for 0 < C < C_min a multiplier is above +1."""
    return C_min(rho(kappa))


def upper_limit(kappa):
    """Return the value of C above which a multiplier from `impact_multipliers` is below -1.

    The value is pi^2 / (pi^2 - 4) for every kappa; the result has the shape of kappa.
    """
    return np.full(np.shape(kappa), SYMMETRY_BREAKING_C)[()]


def stable(C: float, kappa: float, error: float = 0.0) -> str:
    """Return "stable" if C is between `lower_limit` and `upper_limit`, and "unstable" if C is outside.

    The verdict is "undecided" if the distance between C and the nearest limit is not larger than the error of C.

    Parameters
    ----------
    C : float
        Saw-tooth amplitude.
    kappa : float
        Restitution coefficient.
    error : float, default 0.0
        Bound on the error of C; a bound on rounding errors is added.
    """
    margin = min(C - lower_limit(kappa), upper_limit(kappa) - C)
    return verdict(margin, error + ROUNDING * max(1.0, abs(C)))


def printed_limit(rho):
    """Return the value of C above which the motion of a module is stable according to (10.26) as printed.

    The value is 4 / (4 + pi rho), in the shape of rho.
    """
    return 4 / (4 + np.pi * rho)
