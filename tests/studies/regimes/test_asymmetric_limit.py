"""Exact asymmetric orbits converge to asymmetric fixed points of the slow flow as epsilon falls."""

import numpy as np
import pytest
from scipy.optimize import brentq

import vibroimpact as vi
from chapter import PARAMETERS
from vibroimpact.exact.orbits.asymmetric import asymmetric_solutions
from vibroimpact.exact.orbits.search import asymmetric_orbit
from vibroimpact.studies.regimes import asymmetric_limit
from vibroimpact.studies.regimes.epsilon_limit import order, paired
from vibroimpact.studies.theory.asymmetric_points import fixed_points, search

EQUAL = vi.System(**PARAMETERS, f10_hat=1.0, f20_hat=1.0)
SMALLER = np.geomspace(0.1, 1e-3, 21)[1:]


@pytest.fixture(scope="module")
def ways():
    """Return the orbits of each mirror pair of the case equal as epsilon falls, by the larger v^2 at epsilon = 0.1."""
    found = [asymmetric_limit.follow(EQUAL, root, SMALLER) for root in asymmetric_solutions(EQUAL)[0]]
    return {round(float(max(way[0].place[2:4])), 3): way for way in found}


@pytest.fixture(scope="module")
def points():
    """Return the asymmetric fixed points of the case equal."""
    return search(EQUAL)


def distance_to_limit(station, point):
    """Return the differences of coordinates and multipliers between an orbit and a fixed point."""
    system, exact = station.system, asymmetric_orbit(station.system, station.root).multipliers
    offset = asymmetric_limit.offset(station, point)
    return paired(system, offset, exact, point.slow_eigenvalues, point.fast(system.kappa))


def test_every_pair_converges_to_its_own_point_at_first_order(ways, points):
    ends = [asymmetric_limit.leads_to(way, points) for way in ways.values()]
    assert len(ends) == 4
    assert None not in ends
    assert len({id(end) for end in ends}) == 4
    for way, end in zip(ways.values(), ends, strict=True):
        epsilon = np.array([station.system.epsilon for station in way])
        distance = np.array([np.linalg.norm(asymmetric_limit.offset(station, end)) for station in way])
        assert order(epsilon[epsilon < 0.02], distance[epsilon < 0.02])[0] == pytest.approx(1, abs=0.03)


def test_the_limit_of_the_pair_of_fig_10_8_is_just_below_symmetry_breaking(ways, points):
    """At epsilon = 0, v^2 < 0: the pair appears at the epsilon at which the orbit of point (c) loses its symmetry."""
    pair = ways[0.061]
    end = asymmetric_limit.leads_to(pair, points)
    assert -0.002 < end.squared[1] < -0.0015
    assert not end.real
    assert asymmetric_limit.onset(pair) == pytest.approx(0.00218, abs=2e-5)
    station = pair[-1]
    before = max(abs(distance_to_limit(pair[0], end).multipliers))
    assert before == pytest.approx(0.988, abs=1e-3)
    assert station.place[3] == pytest.approx(end.squared[1] + 0.8 * station.system.epsilon, abs=2e-4)


def test_multipliers_converge_to_those_of_impact_maps_and_slow_flow():
    """At the force 1.3, the pair exists down to epsilon = 0. All errors are proportional to epsilon."""
    system = EQUAL.with_(f20_hat=1.3)
    (point,) = [p for p in fixed_points(system) if 0 < p.squared[1] < 0.1]
    roots = asymmetric_solutions(system)[0]
    smaller = np.geomspace(0.1, 4e-4, 31)[1:]
    (way, *_) = [
        way
        for way in (asymmetric_limit.follow(system, root, smaller) for root in roots)
        if asymmetric_limit.leads_to(way, [point]) is point
    ]
    errors = []
    for station in (way[-7], way[-1]):
        found = distance_to_limit(station, point)
        slow = np.abs(found.rates - found.predicted).max()
        fast = np.abs(found.multipliers - found.predicted_multipliers)[4:].max()
        errors.append((found.distance, slow, fast))
    expected = way[-7].system.epsilon / way[-1].system.epsilon
    np.testing.assert_allclose(np.divide(*errors), expected, rtol=0.1)
    assert max(errors[1]) < 0.02


@pytest.mark.parametrize(("f20", "between"), [(1.0, (0.0021, 0.0023)), (0.89, (0.0075, 0.0088))])
def test_a_pair_appears_where_the_symmetric_orbit_loses_its_symmetry(f20, between):
    """A multiplier of the symmetric orbit is 1 there. Epsilon falls in steps of about a fifth, as in a build."""
    system = EQUAL.with_(f20_hat=f20)

    def excess(epsilon):
        orbits = [one for one in vi.orbits(system.with_(epsilon=epsilon)) if one.symmetric]
        values = min(orbits, key=lambda one: abs(one.C[1] - 1.681)).multipliers
        return min(values.real[np.abs(values.imag) < 1e-9] - 1, key=abs)

    steps = np.geomspace(0.1, 3e-4, 31)[1:]
    ways = [asymmetric_limit.follow(system, root, steps) for root in asymmetric_solutions(system)[0]]
    onsets = [asymmetric_limit.onset(way) for way in ways if way[-1].system.epsilon > 2e-3]
    assert min(abs(np.array(onsets) - brentq(excess, *between, xtol=1e-10))) < 1e-7
