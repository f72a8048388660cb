"""Pseudo-arclength continuation of the roots of F(x, p) = 0, one parameter p (Keller 1977).

A point z = (x, p) is stepped along the tangent and brought back within the plane across it, so that folds in p are
passed like any other point. A special point is a sign change of a function along the curve, found by Brent's method
in the arclength; every evaluation is a root of F to rounding, so the zero is as sharp as the function itself.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from scipy.linalg import null_space
from scipy.optimize import brentq

_DIFFERENCE = 1e-6  # step in p; central differences then tell dF/dp to about 1e-10
_STEPS = 12
_SETTLED = 1e-13
_TURN = 0.15  # radians by which the tangent may turn in one step
_SHORTEST = 1e-7


class Lost(ArithmeticError):
    """The corrector found no root near its guess."""


@dataclass(frozen=True, eq=False)
class Curve:
    """The solution set of F(x, p) = 0.

    equations(x, p) returns the residual (d,) and its Jacobian (d, d) by x.
    """

    equations: Callable

    def derivative(self, z: np.ndarray) -> np.ndarray:
        """dF/dz, shape (d, d + 1), at z = (x, p)."""
        x, p = z[:-1], z[-1]
        h = _DIFFERENCE * (1 + abs(p))
        by_p = (self.equations(x, p + h)[0] - self.equations(x, p - h)[0]) / (2 * h)
        return np.column_stack([self.equations(x, p)[1], by_p])

    def tangent(self, z: np.ndarray, ahead: np.ndarray) -> np.ndarray:
        """Unit tangent (d + 1,) at a point of the curve, on the side of `ahead`."""
        null = null_space(self.derivative(z), rcond=1e-13)[:, -1]
        return null * np.copysign(1.0, null @ ahead)

    def step(self, z: np.ndarray, tangent: np.ndarray, length: float) -> np.ndarray:
        """The point of the curve in the plane across the tangent, a length ahead of z.

        Raises:
            Lost: Newton's method does not settle.
        """
        guess = z + length * tangent
        point = guess
        by_p = self.derivative(guess)[:, -1]
        for _ in range(_STEPS):
            residual, jacobian = self.equations(point[:-1], point[-1])
            matrix = np.vstack([np.column_stack([jacobian, by_p]), tangent])
            defect = np.append(residual, tangent @ (point - guess))
            if not np.isfinite(matrix).all() or np.linalg.matrix_rank(matrix) < len(matrix):
                break
            change = np.linalg.solve(matrix, defect)
            point = point - change
            if np.abs(change).max() <= _SETTLED * (1 + np.abs(point).max()):
                return point
        raise Lost(f"no root of the equations near {guess}")

    def trace(self, start: np.ndarray, ahead: np.ndarray, longest: float, inside: Callable, points: int = 2000):
        """Points z and tangents along the curve, from a root `start` towards `ahead`, as an iterator.

        Ends with the first point for which inside(z) is False, which is given out, after so many points, or where the
        curve is lost.
        """
        z, tangent, length = start, self.tangent(start, ahead), longest / 4
        yield z, tangent
        for _ in range(points):
            while True:
                try:
                    after = self.step(z, tangent, length)
                    turned = self.tangent(after, tangent)
                    if tangent @ turned > np.cos(_TURN):
                        break
                except Lost:
                    pass
                length /= 2
                if length < _SHORTEST:
                    return
            gentle = tangent @ turned > np.cos(_TURN / 3)
            z, tangent = after, turned
            yield z, tangent
            if not inside(z):
                return
            length = min(longest, 1.5 * length) if gentle else length

    def zero(self, function: Callable, z: np.ndarray, tangent: np.ndarray, end: np.ndarray) -> np.ndarray:
        """The point between z and end (a later point of the curve) at which function(point) vanishes.

        Raises:
            ValueError: the function has the same sign at both.
            Lost: the curve between them cannot be followed from z.
        """
        reach = tangent @ (end - z)
        place = brentq(lambda s: function(self.step(z, tangent, s)), 0.0, reach, xtol=1e-15, rtol=1e-14)
        return self.step(z, tangent, place)
