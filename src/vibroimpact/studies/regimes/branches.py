"""Continue branches of 1:1 responses along a path through the parameters, with stability and special points."""

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

_EQUAL = 1e-6  # values of p this close to an end of the interval count as the end
_APART = 1e-3  # branch points closer than this count as one
COLUMNS = "family", "branch", "piece", "p", "C1", "C2", "stable", "admissible", "special", "closed"
"""Columns of a table of branches."""


@dataclass(frozen=True)
class Path:
    """A line in parameter space: all parameters in `names` equal p, and all other parameters are those of `system`."""

    system: object
    names: tuple[str, ...]

    def __call__(self, p: float):
        """Return the system at p."""
        return self.system.with_(**dict.fromkeys(self.names, p))


@dataclass(frozen=True, eq=False)
class Node:
    """A point of a branch.

    p, x: value of the parameter, and root of the equations. amplitudes: C_1, C_2. kind: type of special point, or "".
    stable, admissible: None at a special point.
    """

    p: float
    x: np.ndarray
    amplitudes: np.ndarray
    kind: str
    stable: bool | None
    admissible: bool | None


@dataclass(frozen=True, eq=False, repr=False)
class Branch(Representation):
    """A part of a solution curve, with its nodes in order. If the curve is closed, the last node is also the first.

    places: points with tangents at the nodes that are not special points. The list may have one more at each end.
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
        """Nodes that are special points."""
        return [node for node in self.nodes if node.kind]

    def pieces(self) -> list[tuple[Node, list[Node]]]:
        """Return the pieces between special points as (inner node, all nodes); the inner node is no special point."""
        cuts = [k for k, node in enumerate(self.nodes) if node.kind]
        found, inner = [], None
        for a, b in pairwise([0, *cuts, len(self.nodes) - 1]):
            piece = self.nodes[a : b + 1]
            inner = next((node for node in piece if not node.kind), inner)
            if len(piece) > 1 and inner is not None:
                found.append((inner, piece))
        return found

    def rows(self, number: int = 0) -> list[dict]:
        """Return one row per node of each piece; a special point has a row in both pieces that it joins."""
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
    """Return the branches of a family through seeds (values of p), and the branches that emanate from these.

    Of two mirror images, only one is followed. A seed at which the search for roots fails is skipped with a warning.

    Parameters
    ----------
    longest : float
        Longest step along the curve.
    symmetric : iterable of Branch, default ()
        Symmetric orbits from which branches of asymmetric orbits start.
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
            except Lost as error:  # for example, if a module is inactive at this p, but active at nearby p
                at = f"{' = '.join(path.names)} = {z[-1]:.6g}"
                warnings.warn(f"{family.name}: skipped the branch through {at}: {error}", stacklevel=3)
                continue
            if len(places) > 1:  # else the seed is a branch point, whose branches are added to `starts` below
                found.append(Branch(family, nodes, places[-1].closing, places))
            for crossing in (np.append(node.x, node.p) for node in nodes if node.kind == BRANCH_POINT):
                if all(np.abs(crossing - known).max() > _APART for known in crossings):
                    crossings.append(crossing)
                    starts += curve.arms(crossing)
    return found


def images(family, system, x, near) -> list[np.ndarray]:
    """Return the root `x` and, for asymmetric orbits, that of the mirror image, with angles close to those of `near`.

    The angles are shifted by whole periods.
    """
    found, turn = [x.copy()], family.turn(system)
    if family is AsymmetricOrbits:
        found.append(family.mirror_image(system, x))
    for image in found:
        image[family.angles] += turn * np.rint((near - image)[family.angles] / turn)
    return found


def _seeds(family, path, seeds):
    """Yield all roots of `family` as z = (x, p), for each seed p."""
    for p in seeds:
        try:
            roots = family.roots(path(p))
        except (ValueError, ArithmeticError) as error:
            at = f"{' = '.join(path.names)} = {p:.6g}"
            warnings.warn(f"{family.name}: skipped the search at {at}: {error}", stacklevel=4)
            continue
        yield from (np.append(root, p) for root in roots)


def _half(family, path, interval, curve, longest, start):
    """Follow a branch from the Place `start` along its tangent; return the nodes and the Places."""
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
        # Tests also change sign at a branch point (`kind` is set just after it).
        if before is not None and not kind:
            nodes += _special(family, path, curve, before, tests_before, place, tests)
        nodes.append(_node(family, path, z, member=member))
        kind = ""
    z = places[-1].z
    if low + _EQUAL < z[-1] < high - _EQUAL and not places[-1].closing:
        nodes.append(_node(family, path, z, kind=_crossing(family, path(z[-1]), z) if curve.singular(z) else LOST))
    return nodes, places


def _crossing(family, system, z):
    """Return SYMMETRY_BREAKING for a branch point z where asymmetric orbits become symmetric, else BRANCH_POINT."""
    merging = family is AsymmetricOrbits and family.is_symmetric(system, z[:-1])
    return SYMMETRY_BREAKING if merging else BRANCH_POINT


def _node(family, path, z, kind="", member=None):
    system, x = path(z[-1]), z[:-1]
    known = (None, None) if member is None else (family.stable(system, member), family.admissible(member))
    return Node(float(z[-1]), x, family.amplitudes(system, x), kind, *known)


def _special(family, path, curve, before, tests, after, values):
    """Return the special points between two neighbouring Places, in order.

    tests, values: test functions at `before` and at `after`, by kind of special point.
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
