"""Pseudo-arclength continuation of the roots of F(x, p) = 0, one parameter p (Keller 1977).

A point z = (x, p) is stepped along the tangent and brought back at the p reached, or, where the tangent has little of
p, within the plane across the tangent, so that folds in p are passed like any other point. A special point is a sign
change of a function along the curve, found by Brent's method in the arclength; every evaluation is a root of F to
rounding, so the zero is as sharp as the function itself.
"""

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from scipy.optimize import brentq

_DIFFERENCE = 1e-6  # step in p; central differences then tell dF/dp to about 1e-10
_STEPS = 12
_SETTLED = 1e-13
_STEEP = 0.2  # part of p in the tangent from which on p is kept: a new p costs more than a new x
_TURN = 0.15  # radians by which the tangent may turn in one step
_SHORTEST = 1e-7


class Lost(ArithmeticError):
    """The corrector found no root near its guess."""


class Place(NamedTuple):
    """A point z = (x, p) of the curve and its unit tangent, both (d + 1,)."""

    z: np.ndarray
    tangent: np.ndarray


@dataclass(frozen=True, eq=False)
class Curve:
    """The solution set of F(x, p) = 0.

    equations(x, p) returns the residual (d,) and its Jacobian (d, d) by x.
    """

    equations: Callable

    def place(self, z: np.ndarray, ahead: np.ndarray) -> Place:
        """A point of the curve with its tangent, on the side of `ahead`, (d + 1,).

        Raises:
            Lost: dF/dz has not full rank to rounding, so that there is no one tangent.
        """
        tangent = _solve(self.equations(z[:-1], z[-1])[1], self._by_p(z), ahead, np.eye(len(z))[-1])
        return Place(z, tangent / np.linalg.norm(tangent))

    def step(self, place: Place, length: float) -> np.ndarray:
        """The point z of the curve next to a step of this length along the tangent.

        Raises:
            Lost: Newton's method does not settle.
        """
        guess = place.z + length * place.tangent
        steep = abs(place.tangent[-1]) > _STEEP
        row = np.eye(len(guess))[-1] if steep else place.tangent
        by_p = np.zeros(len(guess) - 1) if steep else self._by_p(guess)
        z = guess
        for _ in range(_STEPS):
            residual, jacobian = self.equations(z[:-1], z[-1])
            defect = np.append(residual, row @ (z - guess))
            change = _solve(jacobian, by_p, row, defect)
            z = z - change
            if np.abs(change).max() <= _SETTLED * (1 + np.abs(z).max()):
                return z
        raise Lost(f"no root of the equations near {guess}")

    def trace(self, start, ahead, longest: float, inside: Callable, points: int = 2000) -> Iterator[Place]:
        """Places along the curve, from a root `start` towards `ahead`, both (d + 1,).

        Ends with the first point z for which inside(z) is False, which is given out, after so many points, or where the
        curve is lost.

        Args:
            longest: longest step.
        """
        place, length = self.place(start, ahead), longest / 4
        yield place
        for _ in range(points):
            after = self._next(place, length)
            while after is None:
                length /= 2
                if length < _SHORTEST:
                    return
                after = self._next(place, length)
            if place.tangent @ after.tangent > np.cos(_TURN / 3):
                length = min(longest, 1.5 * length)
            place = after
            yield place
            if not inside(place.z):
                return

    def zero(self, function: Callable, place: Place, end: np.ndarray) -> np.ndarray:
        """The point between a place and z = end, a later point of the curve, at which function(z) vanishes.

        Raises:
            ValueError: the function has the same sign at both.
            Lost: the curve between them cannot be followed from the place.
        """
        steep = abs(place.tangent[-1]) > _STEEP
        reach = (end - place.z)[-1] / place.tangent[-1] if steep else place.tangent @ (end - place.z)
        return self.step(place, brentq(lambda s: function(self.step(place, s)), 0.0, reach, xtol=1e-15, rtol=1e-14))

    def _by_p(self, z):
        """dF/dp, shape (d,), at z."""
        x, p = z[:-1], z[-1]
        h = _DIFFERENCE * (1 + abs(p))
        return (self.equations(x, p + h)[0] - self.equations(x, p - h)[0]) / (2 * h)

    def _next(self, place, length):
        """The place a step ahead; None if it is not found or the curve turns too much."""
        try:
            after = self.place(self.step(place, length), place.tangent)
        except Lost:
            return None
        return after if place.tangent @ after.tangent > np.cos(_TURN) else None


def _solve(jacobian, by_p, row, right):
    """Solution of the bordered system with the matrix [[jacobian, by_p], [row]]."""
    try:
        return np.linalg.solve(np.vstack([np.column_stack([jacobian, by_p]), row]), right)
    except np.linalg.LinAlgError:
        raise Lost("the bordered matrix is singular") from None
