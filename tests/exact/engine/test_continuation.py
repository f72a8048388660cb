"""Runs that continue each other have together the events and sums of one long run."""

import pickle
from fractions import Fraction
from functools import cache

import numpy as np
import pytest

import vibroimpact as vi
from attacks import same_events
from chapter import system_of
from vibroimpact.system.state import IMPACT, RELEASE, STICK

CYCLES = 12
START = [0.1, -0.7, 0.2, 0.4, 0.0, 0.3, 0.0, -0.2]
# Restitution, forces, and time of the start. After some cycles balls rest on their walls.
CASES = [
    (0.1, 3.0, 2.0, Fraction(2)), (0.1, 3.0, 2.0, 5.0), (0.05, 1.5, -2.5, 1.0), (0.05, 1.5, -2.5, Fraction(4)),
    (0.05, 5.0, 5.0, 2.0), (0.05, 5.0, 5.0, 5.0),
]  # fmt: skip
ENERGIES = "work", "impacts", "stored"


@cache
def continued(kappa, f10, f20, tau0):
    """Return a long run in which balls chatter and stick, and its pieces of one cycle, each continuing the previous."""
    system = system_of("equal", kappa=kappa, f10_hat=f10, f20_hat=f20)
    runs, state, begin = [], START, tau0
    for _ in range(CYCLES):
        runs.append(vi.simulate(system, state, 1, tau0=begin))
        state, begin = runs[-1].final, runs[-1].end
    return vi.simulate(system, START, CYCLES, tau0=tau0), runs


@pytest.fixture(params=CASES)
def pieces(request):
    return continued(*request.param)


def impacts(run):
    """Return the number of impacts of each module."""
    return np.bincount(run.events["module"][run.events["kind"] == IMPACT], minlength=3)[1:].tolist()


def resting(state):
    """Return the walls on which the balls of a state rest, or 0."""
    gaps, speeds = state[[0, 2]] - state[[1, 3]], state[[4, 6]] - state[[5, 7]]
    return np.where((np.abs(np.abs(gaps) - 1) < 1e-12) & (speeds == 0), np.sign(gaps), 0).astype(int)


def test_pieces_have_the_events_and_energies_of_the_whole(pieces):
    """Impacts at the end of a chatter are ignored: a run that ends during the chatter lists more of them."""
    whole, runs = pieces
    assert same_events(np.concatenate([run.events for run in runs]), whole.events, slow=[1e-6])
    assert {*whole.events["kind"]} == {IMPACT, STICK, RELEASE}
    np.testing.assert_allclose(runs[-1].final, whole.final, rtol=0, atol=1e-9)
    assert sum(resting(run.start).any() for run in runs) > 2
    for name in ENERGIES:
        parts = [getattr(run.energy, name) for run in runs]
        np.testing.assert_allclose(np.sum(parts, axis=0), getattr(whole.energy, name), rtol=1e-8, atol=1e-12)
    for run in runs:
        for other in (*vi.simulate_many(run.system, [run.start], 1, tau0=run.begin), pickle.loads(pickle.dumps(run))):
            np.testing.assert_array_equal(other.events, run.events)


def test_ensembles_of_pieces_have_the_statistics_of_the_whole(pieces):
    whole, runs = pieces
    total = vi.ensemble(whole.system, START, CYCLES, tau0=whole.begin, energy=True)
    parts = np.array([vi.ensemble(run.system, run.start, 1, tau0=run.begin, energy=True) for run in runs])
    assert parts["impacts"].tolist() == [impacts(run) for run in runs]
    assert total["impacts"].tolist() == impacts(whole)
    for name in ("mean_square", "ball_speed"):
        np.testing.assert_allclose(parts[name].mean(axis=0), total[name], rtol=1e-9)
    for name in ENERGIES:
        found, expected = parts["energy"][name].sum(axis=0), total["energy"][name]
        np.testing.assert_allclose(found, expected, rtol=1e-8, atol=1e-12)


def test_pieces_end_with_balls_at_rest_on_each_wall():
    """The comparisons above cover continued contacts only if this holds."""
    finals = [run.final for case in CASES for run in continued(*case)[1]]
    found = {(module, int(wall)) for final in finals for module, wall in enumerate(resting(final), 1) if wall}
    assert found == {(1, 1), (1, -1), (2, 1), (2, -1)}


def test_balls_at_rest_on_walls_stick_at_the_start_of_a_run_that_continues_no_other():
    """The start may be at any time; a run of no length lists both sticks, and its continuation does not."""
    whole, runs = continued(*CASES[0])
    system, state = whole.system, next(run.final for run in runs if all(resting(run.final)))
    for tau0 in (2.0, Fraction(2)):
        fresh = vi.simulate(system, state, 1, tau0=tau0)
        assert fresh.events[["tau", "kind"]][:2].tolist() == [(2.0, STICK), (2.0, STICK)]
        assert {*fresh.events["module"][:2]} == {1, 2}
        none = vi.simulate(system, state, 0, tau0=tau0)
        rest = vi.simulate(system, state, 1, tau0=none.end)
        assert len(none.events) == 2
        np.testing.assert_array_equal(rest.events, fresh.events[2:])
        np.testing.assert_array_equal(rest.jacobian, fresh.jacobian)
        assert rest.certificate == fresh.certificate


def test_an_impact_at_the_start_without_rebound_is_listed_in_continued_runs_too():
    """The restitution coefficient is so small that the ball sticks immediately."""
    system = continued(*CASES[0])[0].system.with_(kappa=1e-300)
    state = np.array([-2.5, -3.5, -2.5, -3.5, 0.1, 0.0, 0.0, 0.0])
    listed = [(IMPACT, 1), (STICK, 1), (STICK, 2)]
    end = vi.simulate(system, START, 0).end
    for tau0, expected in ((0.0, listed), (end, listed[:2])):
        run = vi.simulate(system, state, 1, tau0=tau0)
        assert run.events[["kind", "module"]][run.events["tau"] == 0.0].tolist() == expected
        assert vi.ensemble(system, state, 1, tau0=tau0)["impacts"].tolist() == impacts(run)
