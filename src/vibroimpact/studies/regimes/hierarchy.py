"""The levels from leading order to the exact orbit: symmetric motions by each, and their cost.

Levels, in order: leading order; two terms; N harmonics of the boxes' centre coordinate U_i at finite epsilon
(`exact.orbits.harmonics`); exact. The cost is counted, not timed: how many terms of the boxes' response are summed
until all motions at one pair of forces are found. Leading order knows one, the resonant one; the exact response is a
Taylor series of six. Two terms ask the exact conditions at three small epsilon, once for every epsilon.
"""

from contextlib import suppress
from typing import NamedTuple

import numpy as np

from vibroimpact.exact.orbits.floquet import floquet
from vibroimpact.exact.orbits.impulse_response import HarmonicResponse, impulse_response
from vibroimpact.exact.orbits.search import symmetric_orbit
from vibroimpact.exact.orbits.symmetric import symmetric_solutions
from vibroimpact.studies.regimes import two_terms
from vibroimpact.studies.regimes.epsilon_limit import NoOrbit
from vibroimpact.theory import criteria
from vibroimpact.theory.fixed_points.symmetric_points import fixed_points

LEADING, TWO_TERMS, EXACT = "leading order", "two terms", "exact"
_TAYLOR_TERMS = 6


class Level(NamedTuple):
    """The motions that a level finds in a system.

    C: (n, 2) of its motions; verdicts: on each, none by harmonics; cost: terms summed.
    """

    C: np.ndarray
    verdicts: list[str]
    cost: int


class _Counted:
    """A response of the boxes that counts its evaluations."""

    def __init__(self, response):
        self._response, self.evaluations = response, 0

    def between(self, times, boxes):
        self.evaluations += times[..., 0].size
        return self._response.between(times, boxes)


def harmonics_name(highest: int) -> str:
    """Name of the level of N harmonics."""
    return f"N = {highest}"


def levels(system, harmonics) -> dict[str, Level]:
    """Every level for one system, by name, from the lowest to the exact one.

    Args:
        harmonics: the numbers N, odd, ascending.
    """
    points = fixed_points(system)
    leading = [criteria.of_fixed_point(system, point)["theory"] for point in points]
    found = {LEADING: Level(_stack([point.C for point in points]), leading, 1), TWO_TERMS: _two_terms(system, points)}
    found |= {harmonics_name(N): of_harmonics(system, N, free_mass=True) for N in harmonics}
    roots, evaluations = _solved(system, impulse_response(system, -1))
    verdicts = [floquet(symmetric_orbit(system, root)) for root in roots]
    return found | {EXACT: Level(roots[:, 2:], verdicts, _TAYLOR_TERMS * evaluations)}


def of_harmonics(system, highest: int, free_mass: bool) -> Level:
    """The level of N harmonics, of U_i or (free_mass False) of the balls' force on the boxes."""
    response = HarmonicResponse(system, highest, free_mass)
    roots, evaluations = _solved(system, response)
    return Level(roots[:, 2:], [], response.terms * evaluations)


def error(C: np.ndarray, exact: np.ndarray) -> float:
    """Largest relative error of a level's C (n, 2) against the exact (m, 2); nan if n is not m."""
    C, exact = np.nan_to_num(C), np.nan_to_num(exact)
    if len(C) != len(exact):
        return np.nan
    if not len(C):
        return 0.0
    off = np.abs(C[:, None] - exact[None]).max(axis=2) / np.abs(exact).max(axis=1)
    return float(max(off.min(axis=0).max(), off.min(axis=1).max()))


def _two_terms(system, points):
    responses, C, verdicts = [], [], []

    def counted(system, sign):
        responses.append(_Counted(impulse_response(system, sign)))
        return responses[-1]

    for point in points:
        with suppress(NoOrbit):
            C.append(two_terms.amplitudes(system, point, counted))
            verdicts.append(two_terms.verdict(system, point, C[-1]))
    return Level(_stack(C), verdicts, _TAYLOR_TERMS * sum(one.evaluations for one in responses))


def _solved(system, response):
    """The roots (n, 4) that are motions, no C < 0, and the number of evaluations of the response."""
    counted = _Counted(response)
    roots = symmetric_solutions(system, counted)
    return roots[(roots[:, 2:] >= 0).all(axis=1)], counted.evaluations


def _stack(C):
    return np.reshape(C, (-1, 2))
