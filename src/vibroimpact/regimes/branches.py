"""Branches of 1:1 responses along a path through the parameters, with stability and special points."""

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from vibroimpact.regimes.continuation import Curve, Lost
from vibroimpact.regimes.families import SPEED_ZERO, AsymmetricOrbits, flight_fractions
from vibroimpact.system.representation import Representation, brief

_SAME = 1e-6
COLUMNS = "family", "branch", "piece", "p", "C1", "C2", "stable", "admissible", "special"
"""Columns of a table of branches."""


@dataclass(frozen=True)
class Path:
    """A line through the parameters: every named one has the value p, the others those of the system."""

    system: object
    names: tuple[str, ...]

    def __call__(self, p: float):
        """The system at p."""
        return self.system.with_(**dict.fromkeys(self.names, p))


@dataclass(frozen=True, eq=False)
class Node:
    """A point of a branch.

    p, x: parameter and root. amplitudes: C_1, C_2, shape (2,). kind: what is special about it, or "".
    stable, admissible: of the member there, None at a special point.
    """

    p: float
    x: np.ndarray
    amplitudes: np.ndarray
    kind: str
    stable: bool | None
    admissible: bool | None


@dataclass(frozen=True, eq=False, repr=False)
class Branch(Representation):
    """A piece of a solution curve: its nodes in their order along it."""

    family: object
    nodes: list[Node]

    def _shown(self):
        ends = brief([self.nodes[0].p, self.nodes[-1].p])
        kinds = [f"{node.kind} at {node.p:.4g}" for node in self.special]
        return {"family": self.family.name, "p": ends, "nodes": str(len(self.nodes)), "special": ", ".join(kinds)}

    @property
    def special(self) -> list[Node]:
        """The special points."""
        return [node for node in self.nodes if node.kind]

    def pieces(self) -> list[tuple[Node, list[Node]]]:
        """Pieces between special points, both included, each with an inner node, whose stability is that of all."""
        cuts = [k for k, node in enumerate(self.nodes) if node.kind]
        found, inner = [], None
        for a, b in pairwise([0, *cuts, len(self.nodes) - 1]):
            piece = self.nodes[a : b + 1]
            inner = next((node for node in piece if not node.kind), inner)
            if len(piece) > 1 and inner is not None:
                found.append((inner, piece))
        return found

    def rows(self, number: int = 0) -> list[dict]:
        """A row per node, along the pieces between special points, which belong to the pieces they join."""
        return [
            {
                "family": self.family.name,
                "branch": number,
                "piece": piece,
                "p": node.p,
                "C1": float(node.amplitudes[0]),
                "C2": float(node.amplitudes[1]),
                "stable": inner.stable,
                "admissible": inner.admissible,
                "special": node.kind,
            }
            for piece, (inner, nodes) in enumerate(self.pieces())
            for node in nodes
        ]


def branches(
    family, path: Path, interval, seeds: Iterable[float], longest: float, tell: Callable = lambda p: None
) -> list[Branch]:
    """All branches of a family within an interval of p that pass one of the seeds (values of p).

    A branch ends at the ends of the interval, where a ball speed vanishes, and, for asymmetric orbits, where it meets
    its mirror image on a symmetric one; of two mirror images one is followed. A closed branch without a root at a seed
    is missed.

    Args:
        family: one of `families.FAMILIES`. path: gives the system at p.
        longest: longest step along the curve.
        tell: called with p at each seed and node, for a report of progress.
    """
    found = []
    for p in seeds:
        tell(p)
        system = path(p)
        for root in family.roots(system):
            known = any(_passes(branch, path, p, image) for branch in found for image in family.images(system, root))
            if family.speed(root) > 0 and not known:
                found.append(_branch(family, path, interval, np.append(root, p), longest, tell))
    return found


def _branch(family, path, interval, start, longest, tell):
    """The branch through a root, followed both ways."""
    ahead = np.eye(len(start))[-1]
    there, back = (_half(family, path, interval, start, sign * ahead, longest, tell) for sign in (1, -1))
    return Branch(family, back[:0:-1] + there)


def _half(family, path, interval, start, ahead, longest, tell):
    """Nodes on one side of the start."""
    low, high = interval
    curve = Curve(lambda x, p: family.equations(_system(path, p), x))
    nodes, before = [], None
    for place in curve.trace(start, ahead, longest, inside=lambda z: low <= z[-1] <= high):
        z = place.z
        tell(float(z[-1]))
        system = path(z[-1])
        if family.speed(z[:-1]) <= 0:
            end = curve.zero(lambda at: family.speed(at[:-1]), before[0], z)
            return [*nodes, _node(family, path, end, kind=SPEED_ZERO)]
        member = family.member(system, z[:-1])
        tests = family.tests(system, member)
        if before is not None:
            if family is AsymmetricOrbits and _meets_mirror_image(path, before[0].z, z):
                return nodes
            nodes += _crossings(family, path, curve, before, (z, tests))
        nodes.append(_node(family, path, z, member=member))
        before = place, tests
    return nodes


def _system(path, p):
    """The system at p; where there is none, a shorter step may still find one."""
    try:
        return path(p)
    except ValueError as error:
        raise Lost(str(error)) from None


def _node(family, path, z, kind="", member=None):
    system, x = path(z[-1]), z[:-1]
    plain = member is not None
    return Node(
        p=float(z[-1]),
        x=x,
        amplitudes=family.amplitudes(system, x),
        kind=kind,
        stable=family.stable(system, member) if plain else None,
        admissible=family.admissible(member) if plain else None,
    )


def _meets_mirror_image(path, before, after):
    """True if an asymmetric branch has just passed the symmetric orbit that it springs from."""
    asymmetry = [flight_fractions(path(z[-1]), z[:-1]) - 0.5 for z in (before, after)]
    return asymmetry[0] @ asymmetry[1] < 0


def _crossings(family, path, curve, before, after):
    """Special points between two neighbouring points of the curve, in their order."""
    place, tests = before
    end, values = after

    def test(at, kind):
        system = path(at[-1])
        return family.tests(system, family.member(system, at[:-1]))[kind]

    found = []
    for kind in tests:
        if tests[kind] * values[kind] < 0:
            zero = curve.zero(lambda at, kind=kind: test(at, kind), place, end)
            if family.genuine(kind, family.member(path(zero[-1]), zero[:-1])):
                found.append((place.tangent @ zero, _node(family, path, zero, kind=kind)))
    return [node for _, node in sorted(found, key=lambda pair: pair[0])]


def _passes(branch, path, p, root):
    """True if a root at p lies on the branch."""
    for (p0, x0), (p1, x1) in pairwise((node.p, node.x) for node in branch.nodes):
        if p0 != p1 and min(p0, p1) <= p <= max(p0, p1):
            chord = x1 - x0
            x = _polished(branch.family, path(p), x0 + (p - p0) / (p1 - p0) * chord)
            near = np.linalg.norm(x - x0) < 2 * np.linalg.norm(chord) + _SAME
            if near and same_root(branch.family, path(p), x, root):
                return True
    return False


def _polished(family, system, x):
    """The root that Newton's method finds from a point next to a branch."""
    for _ in range(8):
        residual, jacobian = family.equations(system, x)
        x = x - np.linalg.solve(jacobian, residual)
    return x


def same_root(family, system, x, root) -> bool:
    """True if two roots of a family are one, times compared on their circle."""
    gap, turn = x - root, family.turn(system)
    gap[family.angles] -= turn * np.rint(gap[family.angles] / turn)
    return bool(np.abs(gap).max() < _SAME)
