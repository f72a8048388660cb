"""Continue folds and symmetry breaking of 1:1 responses in the plane of two parameters.

On a curve of special points the equations of a response hold and one more function vanishes. At a fold, this function
is the determinant of the Jacobian of the equations. At the symmetry breaking of an exact orbit, it is the determinant
of the part of the Jacobian of `AsymmetricConditions` that belongs to antisymmetric changes of the impact times. At the
symmetry breaking of a fixed point, it is the difference between C_i and its upper limit for stable impacts (Masri).
"""

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial

import numpy as np

from vibroimpact.exact.orbits.asymmetric import AsymmetricConditions
from vibroimpact.studies.regimes.branches import Branch, equations, images
from vibroimpact.studies.regimes.continuation import Curve, Lost
from vibroimpact.studies.regimes.families import (
    FOLD,
    SYMMETRY_BREAKING,
    AsymmetricOrbits,
    FixedPoints,
    SymmetricOrbits,
    asymmetric_root,
)
from vibroimpact.system.representation import Representation, brief
from vibroimpact.theory.masri import SYMMETRY_BREAKING_C

_DIFFERENCE = 1e-6


@dataclass(frozen=True)
class Plane:
    """A rectangle in the plane of two parameters of System: their names, and limits (2, 2), (low, high) for each."""

    system: object
    names: tuple[str, str]
    limits: np.ndarray

    def __call__(self, p: float, q: float):
        """Return the system at the point (p, q).

        Raises
        ------
        Lost
            If the point does not give a valid system.
        """
        try:
            return self.system.with_(**dict(zip(self.names, (float(p), float(q)), strict=True)))
        except ValueError as error:
            raise Lost(str(error)) from None

    def margin(self, z) -> float:
        """Return the distance of z = (..., p, q) from the nearest edge, divided by the rectangle's width across it.

        The result is negative outside the rectangle.
        """
        low, high = self.limits.T
        return float(np.minimum((z[-2:] - low) / (high - low), (high - z[-2:]) / (high - low)).min())


@dataclass(frozen=True, eq=False, repr=False)
class BifurcationCurve(Representation):
    """A curve of special points of one family of responses.

    family: family of the responses. kind: "fold" or "symmetry breaking", with the module for fixed points ("symmetry
    breaking, module 1"). names: names of both parameters. points: (n, 2), values of the parameters in order along the
    curve. amplitudes: (n, 2), C_1, C_2 at the points. x: (n, d), roots of the family's equations at the points.
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
        """Return one row per point with the columns family, curve, special, both parameters, C1, C2."""
        of = {"family": self.family.name, "curve": number, "special": self.kind}
        return [
            {**of, **dict(zip(self.names, point, strict=True)), "C1": C1, "C2": C2}
            for point, (C1, C2) in zip(self.points.tolist(), self.amplitudes.tolist(), strict=True)
        ]


def bifurcation_curves(
    plane: Plane, branches: list[tuple[float, Branch]], longest: float, report: Callable = lambda p, q: None
) -> list[BifurcationCurve]:
    """Return the curves that pass through folds and symmetry breakings of the given branches, inside the rectangle.

    Parameters
    ----------
    branches : list[tuple[float, Branch]]
        Pairs of a value of the second parameter and a Branch along the first parameter at this value.
    longest : float
        Longest step along a curve.
    report : callable, optional
        Called with both parameters at each point, to report progress.
    """
    found, passed = [], []
    for q, branch in branches:
        for node in branch.special:
            if node.kind not in TESTS[branch.family.name]:
                continue
            z, of = np.array([*node.x, node.p, q]), (branch.family, node.kind)
            curve = _curve(plane, *of)
            known = any(curve.passes(places, z) for one, places in passed if one == of)
            if plane.margin(z) >= 0 and not known:
                points, places = curve.both_ways(z, partial(_half, plane, branch.family, curve, longest, report))
                points = np.array(points)
                passed.append((of, places))
                systems = [plane(*point) for point in points[:, -2:]]
                amplitudes = [branch.family.amplitudes(*one) for one in zip(systems, points[:, :-2], strict=True)]
                found.append(BifurcationCurve(*of, plane.names, points[:, -2:], np.array(amplitudes), points[:, :-2]))
    return found


def symmetry_breaking(system, x) -> float:
    """Return the determinant that vanishes where the symmetry of an orbit breaks.

    `x` is the root (tau_1, tau_2, C_1, C_2) of the orbit. An antisymmetric change shifts the impact times of a module
    at its two walls by opposite amounts. Each module has a condition of restitution at each wall. An antisymmetric
    change affects the sum of the two conditions of a module, but not their difference. The result is the determinant of
    the derivatives of the sums of both modules.
    """
    jacobian = AsymmetricConditions(system)(asymmetric_root(system, x)[None])[1][0]
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
"""Functions of (system, root) that vanish at special points, by family and by kind of the point."""


def _curve(plane, family, kind):
    """Return the Curve of (x, p, q) on which the equations of a family hold and the test for `kind` vanishes."""
    test, of_family = TESTS[family.name][kind], equations(family, plane)

    def extended(y, q):
        system, x = plane(y[-1], q), y[:-1]
        residual, jacobian = of_family(x, y[-1], q)
        steps = _DIFFERENCE * (1 + np.abs(y))
        by = np.empty((len(y), len(y)))
        by[:-1, :-1] = jacobian
        for k, step in enumerate(steps[:-1]):
            shift = np.where(np.arange(len(x)) == k, step, 0.0)
            by[-1, k] = (test(system, x + shift) - test(system, x - shift)) / (2 * step)
        ahead, behind = (y[-1] + sign * steps[-1] for sign in (1, -1))
        by[:-1, -1] = (of_family(x, ahead, q)[0] - of_family(x, behind, q)[0]) / (2 * steps[-1])
        by[-1, -1] = (test(plane(ahead, q), x) - test(plane(behind, q), x)) / (2 * steps[-1])
        return np.append(residual, test(system, x)), by

    def same(z, near):
        return [np.append(x, z[-2:]) for x in images(family, plane(*z[-2:]), z[:-2], near[:-2])]

    return Curve(extended, same)


def _half(plane, family, curve, longest, report, start):
    """Return the points (x, p, q) and the Places of a curve from the Place `start` on, along its tangent.

    The curve ends at the edge of the rectangle `plane`, or where a ball speed vanishes.
    """

    def margin(z):
        return min(plane.margin(z), family.speed(z[:-2]))

    found, places = [], []
    for place in curve.trace(start, longest, inside=lambda z: margin(z) >= 0):
        report(*place.z[-2:])
        if place.determinant == 0:
            continue
        end = margin(place.z) < 0 and places and margin(places[-1].z) > 0
        found.append(curve.zero(margin, places[-1], place.z) if end else place.z)
        places.append(place)
    return found, places
