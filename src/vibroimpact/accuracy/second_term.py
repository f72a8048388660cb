"""Compute the second term of (10.7) from the derivative of exact orbits with respect to epsilon, at epsilon = 0.

The method of multiple scales gives the same term, because an asymptotic series is unique.
"""

import numpy as np

from vibroimpact.exact.orbits.newton import newton
from vibroimpact.exact.orbits.symmetric import SymmetricConditions
from vibroimpact.system import System
from vibroimpact.theory.response import impact_times

STEP = 2e-4
"""Smallest epsilon of the finite differences; with this value, the sum of the first two terms of (10.7) is accurate to
1e-8."""


class NoOrbit(ValueError):
    """Raised if no symmetric orbit is found next to a fixed point."""


def first_order(system, point) -> np.ndarray:
    """Return the second terms of (10.7) divided by epsilon, shape (2, 2): one column per module.

    Row 0 contains the terms for the amplitudes C. Row 1 contains the terms for the impact phases [rad].

    Raises
    ------
    NoOrbit
        If Newton's method finds no orbit.
    """

    def slope(epsilon):
        here, root = near(system, point, epsilon)
        return offsets(here, point, root) / epsilon

    return at_zero(slope)


def at_zero(slope):
    """Return the limit of an analytic function slope(epsilon) at 0, with an error of order STEP^3."""
    low, middle, high = (slope(n * STEP) for n in (1, 2, 4))
    return (8 * low - 6 * middle + high) / 3


def near(system, point, epsilon: float) -> tuple[System, np.ndarray]:
    """Return the system with the given epsilon, and the symmetric orbit of this system next to a fixed point.

    The orbit is an array of two impact times and two amplitudes C.

    Raises
    ------
    NoOrbit
        If Newton's method finds no orbit.
    """
    here = system.with_(epsilon=epsilon)
    start = np.nan_to_num(np.concatenate([impact_times(here, point), point.C]))
    roots = newton(SymmetricConditions(here), start[None])
    if not len(roots):
        where = f"next to fixed point {point.label!r} at epsilon = {epsilon:g}"
        raise NoOrbit(f"model: second_term needs a symmetric 1:1 orbit {where}, and Newton's method found none")
    return here, roots[0]


def offsets(system, point, roots) -> np.ndarray:
    """Return the differences between orbits and a fixed point, shape (..., 2, 2): one column per module.

    Row 0 contains the differences in C. Row 1 contains the differences in the impact phases [rad].

    roots: orbits, shape (..., 4); an orbit is given by two impact times and two amplitudes C.
    """
    phases = np.angle(np.exp(1j * system.Omega * (roots[..., :2] - impact_times(system, point))))
    return np.stack([roots[..., 2:] - point.C, phases], axis=-2)
