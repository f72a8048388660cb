"""Second term of (10.7): derivative by epsilon, at 0, of the solution of the exact conditions of an orbit.

Since an asymptotic series is unique, this is the term that the method of multiple scales gives.
"""

import numpy as np

from vibroimpact.exact.orbits.newton import newton
from vibroimpact.exact.orbits.symmetric import SymmetricConditions
from vibroimpact.system import System
from vibroimpact.theory.response import impact_times

STEP = 2e-4
"""Smallest epsilon of the finite differences; the result with two terms is then accurate to 1e-8."""


class NoOrbit(ValueError):
    """Raised if there is no symmetric orbit to compare a fixed point with."""


def first_order(system, point) -> np.ndarray:
    """Return the second term of (10.7) at a fixed point, per epsilon: of C and of the impact phases [rad], (2, 2).

    A module that takes no part has NaN.

    Raises
    ------
    NoOrbit
        If Newton's method reaches no orbit.
    """

    def slope(epsilon):
        here, root = near(system, point, epsilon)
        return offsets(here, point, root) / epsilon

    return at_zero(slope)


def at_zero(slope):
    """Return the limit of slope(epsilon), analytic, at epsilon = 0, by Richardson's extrapolation from three values.

    Its error is of order STEP^3.
    """
    low, middle, high = (slope(n * STEP) for n in (1, 2, 4))
    return (8 * low - 6 * middle + high) / 3


def near(system, point, epsilon: float) -> tuple[System, np.ndarray]:
    """Return the system at another epsilon, and the root (4,) of its symmetric conditions next to a fixed point.

    Raises
    ------
    NoOrbit
        If Newton's method reaches none from the fixed point.
    """
    here = system.with_(epsilon=epsilon)
    start = np.nan_to_num(np.concatenate([impact_times(here, point), point.C]))
    roots = newton(SymmetricConditions(here), start[None])
    if not len(roots):
        raise NoOrbit("system: Newton's method reaches no symmetric 1:1 orbit from the fixed point")
    return here, roots[0]


def offsets(system, point, roots) -> np.ndarray:
    """Return exact roots (..., 4) minus the fixed point: C and impact phases [rad], (..., 2, 2).

    A module that takes no part has NaN.
    """
    phases = np.angle(np.exp(1j * system.Omega * (roots[..., :2] - impact_times(system, point))))
    return np.stack([roots[..., 2:] - point.C, phases], axis=-2)
