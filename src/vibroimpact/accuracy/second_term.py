"""Compute the second term of (10.7) from the derivative of exact orbits with respect to epsilon, at epsilon = 0.

An asymptotic series is unique, so that the method of multiple scales gives the same term.
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
    """Return the epsilon-derivatives of C (row 0) and of the impact phases [rad] (row 1) at a fixed point, (2, 2).

    Multiplied by epsilon, they are the second terms of (10.7). An inactive module (`System.modules`) has NaN.

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
    """Return the limit of the analytic function slope(epsilon) at epsilon = 0, by Richardson extrapolation.

    Three values of the function are used, so that the error is of order STEP^3.
    """
    low, middle, high = (slope(n * STEP) for n in (1, 2, 4))
    return (8 * low - 6 * middle + high) / 3


def near(system, point, epsilon: float) -> tuple[System, np.ndarray]:
    """Return the system with the given epsilon, and the symmetric orbit (4,) of this system next to a fixed point.

    The orbit is given as a root of SymmetricConditions: [impact times, amplitudes C].

    Raises
    ------
    NoOrbit
        If Newton's method, started at the fixed point, finds no root.
    """
    here = system.with_(epsilon=epsilon)
    start = np.nan_to_num(np.concatenate([impact_times(here, point), point.C]))
    roots = newton(SymmetricConditions(here), start[None])
    if not len(roots):
        where = f"next to fixed point {point.label!r} at epsilon = {epsilon:g}"
        raise NoOrbit(f"model: second_term needs a symmetric 1:1 orbit {where}, and Newton's method found none")
    return here, roots[0]


def offsets(system, point, roots) -> np.ndarray:
    """Return C (row 0) and impact phases [rad] (row 1) of orbits, minus those of a fixed point.

    `roots` (..., 4) are the roots of SymmetricConditions that describe the orbits. The result has the shape
    (..., 2, 2); entries of an inactive module are NaN.
    """
    phases = np.angle(np.exp(1j * system.Omega * (roots[..., :2] - impact_times(system, point))))
    return np.stack([roots[..., 2:] - point.C, phases], axis=-2)
