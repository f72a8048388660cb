"""Follow the roots of F(x, p) = 0 as a parameter p varies, by pseudo-arclength continuation (Keller 1977).

A step leads from a point z = (x, p) along the tangent. Newton's method then corrects x at constant p. Where the tangent
has a small component along p, the correction is normal to the tangent instead. In this way, folds in p can be passed.

At a special point, such as a period doubling, a test function changes sign. Brent's method in the arclength finds the
zero of the test function. The test function is only evaluated at roots that are accurate to rounding. Therefore the
zero is as accurate as the test function.

Branches cross at a branch point, where the determinant of [[dF/dz], [tangent]] changes sign. Newton's method is
ill-conditioned near a branch point. Therefore the branch point is bracketed by bisection, and a step passes over it.
At a branch point, dF/dz has two null vectors and one left null vector. The branches are found on a small circle around
the branch point, in the plane of the two null vectors. A branch crosses the circle where the component of F along the
left null vector vanishes (Lyapunov and Schmidt).
"""

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from itertools import pairwise
from typing import NamedTuple

import numpy as np
from scipy.optimize import brentq

from vibroimpact.system.representation import brief

_DIFFERENCE = 1e-6  # step in p of difference quotients, divided by 1 + |p|; dF/dp is accurate to about 1e-10
_STENCILS = {1: 0.5, -1: -0.5}, {0: -1.5, 1: 2.0, 2: -0.5}, {0: 1.5, -1: -2.0, -2: 0.5}
_MOST_STEPS = 2000
_STEPS, _FEET = 12, 4
# Newton's method ends if the relative size of its last step is at most _SETTLED. If rounding keeps the steps from
# shrinking, a size of at most _STALLED is enough.
_SETTLED, _STALLED = 1e-13, 1e-7
_REFINED = 1e-10
# If the component of the tangent along p is larger than this value, Newton's method keeps p constant, which is cheaper.
_STEEP = 0.2
_TURN = 0.15  # largest angle [rad] by which the tangent may turn in one step
# Length of the shortest step. If a step of this length fails, the continuation looks for a corner of the curve, where
# dF/dz jumps, and goes on behind the corner.
_SHORTEST = 1e-7
# Bisection ends when its interval is shorter than this arclength. At this distance from a branch point, Newton's method
# still gives 10 digits.
_RESOLVED = 1e-6
# A singular value counts as 0 if it is at most this number times (1 + median of the singular values).
_SINGULAR = 1e-5
_CORNER = 1e-5  # length of a step past a corner of the curve, where dF/dz jumps
_CIRCLE, _ANGLES = 1e-4, np.linspace(0.0, 2 * np.pi, 97)


class Lost(ArithmeticError):
    """Raised if Newton's method finds no root near the initial guess, or if F is not defined at a point."""


class Place(NamedTuple):
    """A point z = (x, p) of a curve F(z) = 0, with the unit tangent of the curve at this point.

    z: the point, shape (d + 1,).
    tangent: unit tangent at z, shape (d + 1,).
    determinant: determinant of the matrix [[dF/dz], [tangent]]. At a branch point, it is 0.
    closing: True for the last Place of a closed curve, where the curve returns to its first Place.
    """

    z: np.ndarray
    tangent: np.ndarray
    determinant: float
    closing: bool = False

    def reversed(self) -> "Place":
        """Return the same point with the tangent reversed."""
        return Place(self.z, -self.tangent, -self.determinant)


@dataclass(frozen=True, eq=False)
class Curve:
    """The curves of solutions z = (x, p) of F(x, p) = 0.

    equations: function of (x, p) that returns the residual F, shape (d,), and the Jacobian dF/dx, shape (d, d).
    images: function of (z, near) that returns z and the points that are equivalent to z, such as mirror images. Each
    point is shifted by whole periods to be close to the point `near`.
    """

    equations: Callable
    images: Callable = lambda z, near: [z]

    def place(self, z: np.ndarray, ahead: np.ndarray) -> Place:
        """Return the Place at a point z of the curve.

        The vector `ahead`, shape (d + 1,), selects the sign of the tangent: the scalar product of `ahead` and the
        tangent is positive.
        """
        by_z = self._by_z(z)
        tangent = np.linalg.svd(by_z)[2][-1]
        tangent = np.copysign(1.0, tangent @ ahead) * tangent
        return Place(z, tangent, float(np.linalg.det(np.vstack([by_z, tangent]))))

    def singular(self, z: np.ndarray) -> bool:
        """Return True if dF/dz is singular at z, so that the tangent is not unique.

        The smallest singular value is compared with the median singular value. The largest one is not suitable, since
        it is unbounded near grazing.
        """
        sizes = np.linalg.svd(self._by_z(z), compute_uv=False)
        return bool(sizes[-1] <= _SINGULAR * (1 + np.median(sizes)))

    def step(self, place: Place, length: float) -> np.ndarray:
        """Return the point z after a step of `length` along the tangent of `place`.

        Raise Lost if Newton's method does not converge.
        """
        guess = place.z + length * place.tangent
        steep = abs(place.tangent[-1]) > _STEEP
        row = np.eye(len(guess))[-1] if steep else place.tangent
        by_p = np.zeros(len(guess) - 1) if steep else self._by_p(guess)
        z, size = guess, np.inf
        for _ in range(_STEPS):
            residual, jacobian = self.equations(z[:-1], z[-1])
            change = _solve([[jacobian, by_p[:, None]], [row]], np.append(residual, row @ (z - guess)))
            z = z - change
            last, size = size, np.abs(change).max() / (1 + np.abs(z).max())
            if size <= _SETTLED or last / 2 < size <= _STALLED:
                return z
        raise Lost(f"Newton's method found no point of the branch near {brief(guess)}")

    def trace(self, start: Place, longest: float, inside: Callable) -> Iterator[Place]:
        """Yield the Places along the curve from the Place `start`, including branch points.

        The length of each step along the tangent is at most `longest`. The iteration ends with the first Place for
        which inside(z) is False. The iteration ends earlier if the curve closes or if no further Place is found.
        """
        place, length = start, longest / 4
        yield place
        for _ in range(_MOST_STEPS):
            while not (ahead := self._ahead(place, length)) and length > _SHORTEST:
                length /= 2
            ahead = ahead or ([] if self.singular(place.z) else self._past_corner(place))
            if not ahead:
                return
            *crossing, after = ahead
            yield from crossing
            left = np.linalg.norm(place.z - start.z) > 2 * _RESOLVED
            if left and (image := self.image_on_segment(place, after, start.z)) is not None:
                yield self.place(image, place.tangent)._replace(closing=True)
                return
            if place.tangent @ after.tangent > np.cos(_TURN / 3):
                length = min(longest, 1.5 * length)
            place = after
            yield place
            if not inside(place.z):
                return

    def zero(self, function: Callable, place: Place, end: np.ndarray) -> np.ndarray:
        """Return the point z of the curve at which function(z) is 0.

        The point z is sought between `place` and `end`, a later point of the curve.
        """
        steep = abs(place.tangent[-1]) > _STEEP
        reach = (end - place.z)[-1] / place.tangent[-1] if steep else place.tangent @ (end - place.z)
        try:
            return self.step(place, brentq(lambda s: function(self.step(place, s)), 0.0, reach, xtol=1e-15, rtol=1e-14))
        except (Lost, ValueError):  # steps can fail near a branch point or a jump of dF/dz
            after, sign = self.place(end, place.tangent), np.sign(function(place.z))
            return (self._bisected(place, after, lambda at: function(at.z) * sign > 0) or (after,))[0].z

    def both_ways(self, z: np.ndarray, half: Callable) -> tuple[list, list[Place]]:
        """Return the list of points and the list of Places of the whole curve through a root z.

        Both lists are in order along the curve. The root z is refined first, since a multiple root has few correct
        digits.

        half: function of a Place that returns the same two lists for one part of the curve. This part begins at the
            given Place, in the direction of its tangent.
        """
        for _ in range(_STEPS):
            change = np.linalg.lstsq(self._by_z(z), self.equations(z[:-1], z[-1])[0])[0]
            if np.abs(change).max() < _REFINED:
                break
            z = z - change
        start = self.place(z, np.eye(len(z))[-1])
        points, places = half(start)
        if places[-1].closing:
            return points, places
        back, behind = half(start.reversed())
        return back[:0:-1] + points, [place.reversed() for place in behind[:0:-1]] + places

    def passes(self, places: list[Place], z: np.ndarray) -> bool:
        """Return True if a root z, or a point equivalent to z, lies on the curve through the given Places."""
        return any(self.image_on_segment(*pair, z) is not None for pair in pairwise(places))

    def image_on_segment(self, place: Place, after: Place, z: np.ndarray) -> np.ndarray | None:
        """Return the root z, or a point equivalent to z, if it lies on the curve between two neighbouring Places.

        Otherwise, return None. The function `images` of the curve gives the equivalent points.
        """
        chord = after.z - place.z
        length = np.linalg.norm(chord)
        for image in self.images(z, place.z):
            along = chord @ (image - place.z) / length
            aside = np.linalg.norm(image - place.z - along / length * chord)
            if -_RESOLVED < along < length + _RESOLVED and aside < _TURN * length + _RESOLVED:
                # Near a branch point, `_place_at` fails if it steps to another branch. Bisection then finds the Place.
                found = self._place_at(place, image) or self._bisected(
                    place, after, lambda at, z=image: at.tangent @ (z - at.z) > 0
                )
                if found and np.linalg.norm(found[0].z - image) < 2 * _RESOLVED:
                    return image
        return None

    def arms(self, z: np.ndarray) -> list[np.ndarray]:
        """Return the points at which branches cross a small circle around the branch point z."""
        left, _, right = np.linalg.svd(self._by_z(z))
        unbalanced, plane = left[:, -1:], right[-2:]

        def at(angle):
            """Return a point y near the branch point z, and a number `part`.

            A small circle around z lies in the plane of the null vectors. The projection of y onto this plane is the
            point of the circle at the polar angle `angle`. The results satisfy F(y) + part * unbalanced = 0, where
            `unbalanced` is the left null vector of dF/dz. If `part` is 0, y is on a branch.
            """
            guess = z + _CIRCLE * np.array([np.cos(angle), np.sin(angle)]) @ plane
            y, part = guess, 0.0
            for _ in range(_STEPS // 4):
                residual = self.equations(y[:-1], y[-1])[0] + part * unbalanced[:, 0]
                blocks = [[self._by_z(y), unbalanced], [plane, np.zeros((2, 1))]]
                change = _solve(blocks, np.append(residual, plane @ (y - guess)))
                y, part = y - change[:-1], part - change[-1]
            return y, part

        try:
            signs = [np.sign(at(angle)[1]) for angle in _ANGLES]
            turns = [_ANGLES[k : k + 2] for k in np.flatnonzero(np.diff(signs))]
            return [at(brentq(lambda angle: at(angle)[1], *ends, xtol=1e-9))[0] for ends in turns]
        except Lost:  # F is undefined at some points of the circle
            return []

    def _by_p(self, z):
        """Return the derivative dF/dp at z, shape (d,), by central differences.

        If F is not defined on one side of p, use one-sided differences.
        """
        x, p = z[:-1], z[-1]
        h = _DIFFERENCE * (1 + abs(p))
        for stencil in _STENCILS:
            try:
                return sum(weight * self.equations(x, p + k * h)[0] for k, weight in stencil.items()) / h
            except Lost as error:
                lost = error
        raise lost

    def _by_z(self, z):
        """Return the derivative dF/dz at z, shape (d, d + 1)."""
        return np.column_stack([self.equations(z[:-1], z[-1])[1], self._by_p(z)])

    def _ahead(self, place, length):
        """Return the Places that one step from `place` reaches, in order along the curve, or [] if the step fails.

        If there is a branch point within the step, the list contains this point and Places close to it on both sides.
        If the determinant changes sign without a branch point, the step has jumped to another curve. Such a step fails.
        """
        after = self._next(place, length)
        if after is None or after.determinant * place.determinant > 0:
            return [after] if after else []
        pair = self._bisected(place, after, lambda at: at.determinant * place.determinant > 0)
        if pair is None:
            return []
        a, b = pair
        part = a.determinant / (a.determinant - b.determinant)
        crossing = Place(a.z + part * (b.z - a.z), a.tangent, 0.0)
        behind, beyond = self._next(a.reversed(), _CIRCLE), self._next(b, _CIRCLE)
        found = [behind and behind.reversed(), crossing, beyond, after]
        return [
            at for at in found if at and 0 < place.tangent @ (at.z - place.z) <= place.tangent @ (after.z - place.z)
        ]

    def _next(self, place, length):
        """Return the Place after one step of `length` from `place`.

        If the step fails or the curve turns too much, return None.
        """
        try:
            after = self.place(self.step(place, length), place.tangent)
        except Lost:
            return None
        return after if place.tangent @ after.tangent > np.cos(_TURN) else None

    def _place_at(self, place, z):
        """Return a list with the Place at the point z, or [] if a search from `place` does not find z on the curve."""
        for _ in range(_FEET):
            place = self._next(place, place.tangent @ (z - place.z))
            if place is None:
                break
            if np.linalg.norm(place.z - z) < _RESOLVED:
                return [place]
        return []

    def _past_corner(self, place):
        """Return a list with the Place beyond a corner just ahead of `place`, or [] if there is no corner.

        At a corner of the curve, dF/dz jumps. An example is an orbit at which impacts of both modules change their
        order.
        """
        try:
            across = self.place(place.z + _CORNER * place.tangent, place.tangent)
        except Lost:
            return []
        after = (self._next(way._replace(z=place.z), _CORNER) for way in (across, across.reversed()))
        return [one for one in after if one and abs(place.tangent @ one.tangent) < np.cos(_TURN)][:1]

    def _bisected(self, place, after, before: Callable):
        """Bisect the curve between two Places; return two close Places at which `before` has different values.

        The function `before` returns True for the first of the close Places, and False for the second. The close Places
        are at most _RESOLVED apart.

        If the curve does not join `place` and `after`, return None. If no step succeeds, bisection ends earlier. The
        result is then the last two Places if dF/dz is singular at the first of them, else None.
        """
        while (length := np.linalg.norm(after.z - place.z)) > _RESOLVED:
            if place.tangent @ (after.z - place.z) < np.cos(_TURN) * length:
                return None
            # A step that ends near a branch point may fail, so other lengths are tried.
            steps = (self._next(place, part * length) for part in (0.5, 0.4, 0.6))
            middle = next(filter(None, steps), None)
            if middle is None:
                return (place, after) if self.singular(place.z) else None
            place, after = (middle, after) if before(middle) else (place, middle)
        return place, after


def _solve(blocks, right):
    """Return the solution of the linear system with the matrix in `blocks` and the right side `right`.

    Raise Lost if the matrix is singular.

    blocks: list of rows, each a list of blocks of the matrix.
    """
    try:
        return np.linalg.solve(np.vstack([np.hstack(row) for row in blocks]), right)
    except np.linalg.LinAlgError:
        raise Lost("the equations of the branch are singular") from None
