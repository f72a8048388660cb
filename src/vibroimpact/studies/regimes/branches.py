"""Continue branches of 1:1 responses along a line in parameter space, and find their stability and special points."""

import warnings
from collections import deque
from collections.abc import Iterable
from dataclasses import dataclass
from functools import partial
from itertools import pairwise

import numpy as np

from vibroimpact.studies.regimes.continuation import Curve, Lost, Place
from vibroimpact.studies.regimes.families import (
    BRANCH_POINT,
    FOLD,
    LOST,
    SPEED_ZERO,
    SYMMETRY_BREAKING,
    AsymmetricOrbits,
    SymmetricOrbits,
    asymmetric_root,
)
from vibroimpact.system.representation import Representation, brief

_EQUAL = 1e-6  # a value of p within this distance of an end of the interval counts as the end
_APART = 1e-3  # two branch points within this distance of each other count as one
COLUMNS = "family", "branch", "piece", "p", "C1", "C2", "stable", "admissible", "special", "closed"
"""Columns of a table of branches."""


@dataclass(frozen=True)
class Path:
    """A line in parameter space, along which a number p varies.

    All parameters in `names` are equal to p. All other parameters are those of `system`.
    """

    system: object
    names: tuple[str, ...]

    def __call__(self, p: float):
        """Return the system at the point p of the line."""
        return self.system.with_(**dict.fromkeys(self.names, p))


@dataclass(frozen=True, eq=False)
class Node:
    """A computed point of a branch.

    p: value of the varied parameter.
    x: root of the equations at p, shape (d,).
    amplitudes: saw-tooth amplitudes (C_1, C_2), shape (2,).
    kind: kind of the special point, or "" at any other point.
    stable: True if the response is stable; None at a special point.
    admissible: True if the response is a motion of the system; None at a special point.
    """

    p: float
    x: np.ndarray
    amplitudes: np.ndarray
    kind: str
    stable: bool | None
    admissible: bool | None


@dataclass(frozen=True, eq=False, repr=False)
class Branch(Representation):
    """A part of a solution curve, as a list of its nodes in order along the curve.

    closed: True if the curve is closed. In this case, the last node is equal to the first node.
    places: a Place (point of the curve with the tangent at this point) for each node that is not a special point. At
        each end of the curve, `places` may contain one more Place.
    """

    family: object
    nodes: list[Node]
    closed: bool
    places: list[Place]

    def _shown(self):
        ends = brief([self.nodes[0].p, self.nodes[-1].p])
        kinds = [f"{node.kind} at {node.p:.4g}" for node in self.special]
        shown = {"family": self.family.name, "p": ends, "nodes": str(len(self.nodes)), "closed": str(self.closed)}
        return shown | {"special": ", ".join(kinds)}

    @property
    def special(self) -> list[Node]:
        """Nodes of the branch that are special points."""
        return [node for node in self.nodes if node.kind]

    def pieces(self) -> list[tuple[Node, list[Node]]]:
        """Return the pieces into which special points divide the branch, each as (inner node, list of all nodes).

        The inner node is not a special point. Its stability is the stability of the whole piece.
        """
        cuts = [k for k, node in enumerate(self.nodes) if node.kind]
        found, inner = [], None
        for a, b in pairwise([0, *cuts, len(self.nodes) - 1]):
            piece = self.nodes[a : b + 1]
            inner = next((node for node in piece if not node.kind), inner)
            if len(piece) > 1 and inner is not None:
                found.append((inner, piece))
        return found

    def rows(self, number: int = 0) -> list[dict]:
        """Return one row for each node of each piece of the branch (see `pieces`).

        A special point between two pieces belongs to both pieces. Therefore it has two rows.
        """
        rows = []
        for piece, (inner, nodes) in enumerate(self.pieces()):
            for node in nodes:
                place = self.family.name, number, piece, node.p, *node.amplitudes.tolist()
                values = *place, inner.stable, inner.admissible, node.kind, self.closed
                rows.append(dict(zip(COLUMNS, values, strict=True)))
        return rows


def branches(
    family, path: Path, interval, seeds: Iterable[float], longest: float, symmetric: Iterable[Branch] = ()
) -> list[Branch]:
    """Return all branches of a family that pass a seed, and all branches that emanate from these branches.

    A seed is a value of p at which all roots are searched for. If the search fails, the seed is skipped with a warning.
    Of two mirror images, only one is followed.

    Parameters
    ----------
    longest : float
        Largest length of a step along the curve.
    symmetric : iterable of Branch, default ()
        Branches of symmetric orbits. Branches of asymmetric orbits emanate from these branches.
    """

    def equations(x, p):
        try:
            return family.equations(path(p), x)
        except ValueError as error:
            raise Lost(str(error)) from None

    def same(z, near):
        return [np.append(x, z[-1]) for x in images(family, path(z[-1]), z[:-1], near[:-1])]

    curve = Curve(equations, same)
    half = partial(_half, family, path, interval, curve, longest)
    starts = deque(_seeds(family, path, seeds))
    for branch in symmetric if family is AsymmetricOrbits else ():
        breaking = [node for node in branch.special if node.kind == SYMMETRY_BREAKING]
        for node in breaking if branch.family is SymmetricOrbits else ():
            arms = curve.arms(np.append(asymmetric_root(path(node.p), node.x), node.p))
            starts += [z for z in arms if not family.is_symmetric(path(z[-1]), z[:-1])]
    found, crossings = [], []
    while starts:
        z = starts.popleft()
        new = interval[0] <= z[-1] <= interval[1] and family.speed(z[:-1]) > 0
        if new and not any(curve.passes(branch.places, z) for branch in found):
            try:
                nodes, places = curve.both_ways(z, half)
            except Lost as error:  # this happens, for example, if a module is inactive at p but active at nearby p
                at = f"{' = '.join(path.names)} = {z[-1]:.6g}"
                warnings.warn(f"{family.name}: skipped the branch through {at}: {error}", stacklevel=3)
                continue
            # If only one point of the curve could be computed, no branch is added here. If this point is a branch
            # point, points on the branches through it are added to `starts` below.
            if len(places) > 1:
                found.append(Branch(family, nodes, places[-1].closing, places))
            for crossing in (np.append(node.x, node.p) for node in nodes if node.kind == BRANCH_POINT):
                if all(np.abs(crossing - known).max() > _APART for known in crossings):
                    crossings.append(crossing)
                    starts += curve.arms(crossing)
    return found


def images(family, system, x, near) -> list[np.ndarray]:
    """Return a list with the root x. For an asymmetric orbit, the list also has the root of the mirror image.

    The angles of each root (impact times or phases) are shifted by whole periods. Each angle then differs from the
    corresponding angle of the root `near` by at most half a period.
    """
    found, turn = [x.copy()], family.turn(system)
    if family is AsymmetricOrbits:
        found.append(family.mirror_image(system, x))
    for image in found:
        image[family.angles] += turn * np.rint((near - image)[family.angles] / turn)
    return found


def _seeds(family, path, seeds):
    """Yield z = (x, p) for each seed p and each root x of `family` at p; skip p with a warning if the search fails."""
    for p in seeds:
        try:
            roots = family.roots(path(p))
        except (ValueError, ArithmeticError) as error:
            at = f"{' = '.join(path.names)} = {p:.6g}"
            warnings.warn(f"{family.name}: skipped the search at {at}: {error}", stacklevel=4)
            continue
        yield from (np.append(root, p) for root in roots)


def _half(family, path, interval, curve, longest, start):
    """Follow a branch from the Place `start` in the direction of the tangent at `start`.

    Return the list of the nodes and the list of the Places of the branch, in order along the branch.
    """
    low, high = interval
    nodes, places, tests, kind = [], [], {}, ""
    for place in curve.trace(start, longest, inside=lambda z: low <= z[-1] <= high):
        z = place.z
        system = path(z[-1])
        if place.determinant == 0:
            kind = _crossing(family, system, z)
            nodes.append(_node(family, path, z, kind=kind))
            if kind == SYMMETRY_BREAKING:
                return nodes, [*places, place]
            continue
        before, tests_before = places[-1] if places else None, tests
        places.append(place)
        if family.speed(z[:-1]) <= 0:
            end = curve.place(curve.zero(lambda at: family.speed(at[:-1]), before, z), before.tangent)
            nodes += _special(family, path, curve, before, {}, end, {})
            return [*nodes, _node(family, path, end.z, kind=SPEED_ZERO)], places
        member = family.member(system, z[:-1])
        tests = family.tests(system, member)
        # Test functions also change sign at a branch point. Therefore they are not compared across a branch point. At
        # the first Place after a branch point, `kind` is not empty.
        if before is not None and not kind:
            nodes += _special(family, path, curve, before, tests_before, place, tests)
        nodes.append(_node(family, path, z, member=member))
        kind = ""
    z = places[-1].z
    if low + _EQUAL < z[-1] < high - _EQUAL and not places[-1].closing:
        nodes.append(_node(family, path, z, kind=_crossing(family, path(z[-1]), z) if curve.singular(z) else LOST))
    return nodes, places


def _crossing(family, system, z):
    """Return SYMMETRY_BREAKING if asymmetric orbits become symmetric at the branch point z, else BRANCH_POINT."""
    merging = family is AsymmetricOrbits and family.is_symmetric(system, z[:-1])
    return SYMMETRY_BREAKING if merging else BRANCH_POINT


def _node(family, path, z, kind="", member=None):
    system, x = path(z[-1]), z[:-1]
    known = (None, None) if member is None else (family.stable(system, member), family.admissible(member))
    return Node(float(z[-1]), x, family.amplitudes(system, x), kind, *known)


def _special(family, path, curve, before, tests, after, values):
    """Return the special points between the neighbouring Places `before` and `after`, in order along the curve.

    tests: values of the test functions at `before`, by kind of special point. The kind "fold" is not included.
    values: values of the same test functions at `after`.
    """

    def test(z, kind):
        if kind == FOLD:
            return curve.place(z, before.tangent).tangent[-1]
        system = path(z[-1])
        return family.tests(system, family.member(system, z[:-1]))[kind]

    found = []
    tests, values = ({FOLD: at.tangent[-1], **rest} for at, rest in ((before, tests), (after, values)))
    for kind in values:
        if tests[kind] * values[kind] < 0:
            zero = curve.zero(lambda z, kind=kind: test(z, kind), before, after.z)
            if family.genuine(kind, family.member(path(zero[-1]), zero[:-1])):
                found.append((before.tangent @ zero, _node(family, path, zero, kind=kind)))
    return [node for _, node in sorted(found, key=lambda pair: pair[0])]
