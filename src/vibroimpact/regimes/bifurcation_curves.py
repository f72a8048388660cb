"""Curves of folds and of symmetry breaking of 1:1 responses in the plane of two parameters.

Along such a curve the equations of a response hold, and one function more vanishes: at a fold the determinant of their
Jacobian; where the symmetry of an orbit breaks, that of the part of the asymmetric equations' Jacobian which maps
antisymmetric changes of the impact times; by the theory, the distance of C_i from its upper limit (Masri).
"""

from collections.abc import Callable
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from vibroimpact.exact.orbits.asymmetric import AsymmetricConditions
from vibroimpact.regimes.branches import Branch, same_root
from vibroimpact.regimes.continuation import Curve, Lost
from vibroimpact.regimes.families import FOLD, SYMMETRY_BREAKING, AsymmetricOrbits, FixedPoints, SymmetricOrbits
from vibroimpact.system.amplitude import path_of
from vibroimpact.system.representation import Representation, brief
from vibroimpact.theory.masri import SYMMETRY_BREAKING_C

_DIFFERENCE = 1e-6
_NEWTON, _SAME = 8, 1e-6


@dataclass(frozen=True)
class Plane:
    """Two parameters of System, within a rectangle: names (2,), and limits (2, 2), each (low, high)."""

    system: object
    names: tuple[str, str]
    limits: np.ndarray

    def __call__(self, p: float, q: float):
        """The system at a point.

        Raises:
            Lost: there is none.
        """
        try:
            return self.system.with_(**dict(zip(self.names, (float(p), float(q)), strict=True)))
        except ValueError as error:
            raise Lost(str(error)) from None

    def margin(self, z) -> float:
        """Distance of z = (..., p, q) from the edge over the width of the rectangle, below 0 outside."""
        low, high = self.limits.T
        return float(np.minimum((z[-2:] - low) / (high - low), (high - z[-2:]) / (high - low)).min())


@dataclass(frozen=True, eq=False, repr=False)
class BifurcationCurve(Representation):
    """A curve of special points of one family of responses.

    family, kind: of the response; "fold" or "symmetry breaking", of the theory with its module. names: of both
    parameters. points: (n, 2), their values, in order along the curve. amplitudes: (n, 2), C_1, C_2 there. x: (n, d),
    roots of the family's equations.
    """

    family: object
    kind: str
    names: tuple[str, str]
    points: np.ndarray
    amplitudes: np.ndarray
    x: np.ndarray

    def _shown(self):
        ends = f"{brief(self.points[0])} to {brief(self.points[-1])}"
        named = {"family": self.family.name, "kind": self.kind, "names": ", ".join(self.names)}
        return named | {"points": f"{len(self.points)}, {ends}"}

    def rows(self, number: int = 0) -> list[dict]:
        """A row per point: family, curve, special, both parameters, C1, C2."""
        of = {"family": self.family.name, "curve": number, "special": self.kind}
        return [
            {**of, **dict(zip(self.names, point, strict=True)), "C1": C1, "C2": C2}
            for point, (C1, C2) in zip(self.points.tolist(), self.amplitudes.tolist(), strict=True)
        ]


def bifurcation_curves(
    plane: Plane, branches: list[tuple[float, Branch]], longest: float, tell: Callable = lambda p, q: None
) -> list[BifurcationCurve]:
    """The curves through the folds and symmetry breakings of some branches, within the rectangle.

    Args:
        branches: pairs of a value of the second parameter, and a Branch along the first one there.
        longest: longest step along a curve. tell: called at each point, for a report of progress.
    """
    found = []
    for q, branch in branches:
        for node in branch.special:
            if node.kind not in TESTS[branch.family.name]:
                continue
            z = np.array([*node.x, node.p, q])
            if plane.margin(z) >= 0 and not any(_passes(plane, curve, branch.family, node.kind, z) for curve in found):
                found.append(_curve(plane, branch.family, node.kind, z, longest, tell))
    return found


def symmetry_breaking(system, x) -> float:
    """Determinant that vanishes where the symmetry of a symmetric orbit breaks, from its root (tau_1, tau_2, C_1, C_2).

    Antisymmetric changes move the impacts at both walls oppositely; the sums of the conditions of restitution at both
    walls are what they change.
    """
    times = np.stack([x[:2], x[:2] + system.period / 2], axis=1).ravel()
    root = np.append(times, 4 * path_of(system.epsilon, x[2:]) / system.period)
    jacobian = AsymmetricConditions(system)(root[None])[1][0]
    opposite = np.array([[1, 1, 0, 0, 0, 0], [0, 0, 1, 1, 0, 0]]) @ jacobian[:, :4] @ _OPPOSITE
    part = np.isin([1, 2], system.modules)
    return np.linalg.det(opposite[part][:, part])


_OPPOSITE = np.array([[1, -1, 0, 0], [0, 0, 1, -1]]).T


def _fold(family):
    return {FOLD: lambda system, x: np.linalg.det(family.equations(system, x)[1])}


TESTS = {
    SymmetricOrbits.name: {**_fold(SymmetricOrbits), SYMMETRY_BREAKING: symmetry_breaking},
    AsymmetricOrbits.name: _fold(AsymmetricOrbits),
    FixedPoints.name: _fold(FixedPoints)
    | {f"{SYMMETRY_BREAKING}, module {i + 1}": lambda system, x, i=i: SYMMETRY_BREAKING_C - x[2 * i] for i in range(2)},
}
"""Functions of a system and a root that vanish at special points, by family and kind."""


def _equations(plane, family, kind):
    """Residual (d + 1,) and Jacobian (d + 1, d + 1) by (x, p) of the extended equations, at (x, p) and q."""
    test = TESTS[family.name][kind]

    def extended(y, q):
        system, x = plane(y[-1], q), y[:-1]
        residual, jacobian = family.equations(system, x)
        steps = _DIFFERENCE * (1 + np.abs(y))
        by = np.empty((len(y), len(y)))
        by[:-1, :-1] = jacobian
        for k, step in enumerate(steps[:-1]):
            shift = np.where(np.arange(len(x)) == k, step, 0.0)
            by[-1, k] = (test(system, x + shift) - test(system, x - shift)) / (2 * step)
        ahead, behind = (plane(y[-1] + sign * steps[-1], q) for sign in (1, -1))
        by[:-1, -1] = (family.equations(ahead, x)[0] - family.equations(behind, x)[0]) / (2 * steps[-1])
        by[-1, -1] = (test(ahead, x) - test(behind, x)) / (2 * steps[-1])
        return np.append(residual, test(system, x)), by

    return extended


def _curve(plane, family, kind, start, longest, tell):
    """The curve through a point, followed both ways; a closed one once round."""
    curve = Curve(_equations(plane, family, kind))
    ahead = np.eye(len(start))[-1]
    there, closed = _half(plane, family, curve, start, ahead, longest, tell)
    back = [] if closed else _half(plane, family, curve, start, -ahead, longest, tell)[0][:0:-1]
    z = np.array(back + there)
    systems = [plane(*point) for point in z[:, -2:]]
    amplitudes = [family.amplitudes(system, x) for system, x in zip(systems, z[:, :-2], strict=True)]
    return BifurcationCurve(family, kind, plane.names, z[:, -2:], np.array(amplitudes), z[:, :-2])


def _half(plane, family, curve, start, ahead, longest, tell):
    """Points on one side of the start, to where a ball speed vanishes or the rectangle ends; True if it closes."""

    def margin(z):
        return min(plane.margin(z), family.speed(z[:-2]))

    found, before = [], None
    for place in curve.trace(start, ahead, longest, inside=lambda z: margin(z) >= 0):
        tell(*place.z[-2:])
        if margin(place.z) < 0 and before is not None and margin(before.z) > 0:
            return [*found, curve.zero(margin, before, place.z)], False
        found.append(place.z)
        if len(found) > 3 and np.linalg.norm(place.z - start) < np.linalg.norm(place.z - before.z):
            return [*found, start], True
        before = place
    return found, False


def _passes(plane, curve, family, kind, z):
    """True if a special point lies on a curve."""
    if curve.family is not family or curve.kind != kind:
        return False
    equations, q = _equations(plane, family, kind), z[-1]
    for (one, x0), (two, x1) in pairwise(zip(curve.points, curve.x, strict=True)):
        if one[1] != two[1] and min(one[1], two[1]) <= q <= max(one[1], two[1]):
            part = (q - one[1]) / (two[1] - one[1])
            y = np.append(x0 + part * (x1 - x0), one[0] + part * (two[0] - one[0]))
            try:
                for _ in range(_NEWTON):
                    residual, by = equations(y, q)
                    y = y - np.linalg.solve(by, residual)
                images = family.images(plane(z[-2], q), z[:-2])
            except (Lost, np.linalg.LinAlgError):
                continue
            if abs(y[-1] - z[-2]) < _SAME and any(same_root(family, plane(z[-2], q), y[:-1], x) for x in images):
                return True
    return False
