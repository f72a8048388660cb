"""Runs continued from the ends of others: put together they have the events and sums of the one long run."""

import copy
import pickle
from fractions import Fraction

import numpy as np
import pytest

import vibroimpact as vi
from vibroimpact.system.state import IMPACT, RELEASE, STICK

CYCLES = 12
START = [0.1, -0.7, 0.2, 0.4, 0.0, 0.3, 0.0, -0.2]
SLOW = 1e-6
"""Impacts at the end of a chatter, of which a run that ends meanwhile lists more."""


CASES = {  # restitution and forces; times of the start, a whole number of cycles from which balls rest on their walls
    (0.1, 3.0, 2.0): (Fraction(2), 5.0),
    (0.05, 1.5, -2.5): (1.0, Fraction(4)),
    (0.05, 5.0, 5.0): (2.0, 5.0),
}


def continued(kappa, f10, f20, tau0):
    """The one long run of a system whose balls chatter and stick, and the runs of one cycle that it consists of."""
    system = vi.System(
        epsilon=0.1, kappa=kappa, alpha12_hat=1.0, gamma1_hat=0.2, gamma2_hat=0.2, gamma12_hat=0.2, sigma20_hat=0.5,
        sigma_e_hat=0.2, f10_hat=f10, f20_hat=f20,
    )  # fmt: skip
    runs, state, begin = [], START, tau0
    for _ in range(CYCLES):
        runs.append(vi.simulate(system, state, 1, tau0=begin))
        state, begin = runs[-1].final, runs[-1].end
    return vi.simulate(system, START, CYCLES, tau0=tau0), runs


ALL = [continued(*case, tau0) for case, times in CASES.items() for tau0 in times]


@pytest.fixture(params=ALL)
def pieces(request):
    return request.param


def story(events, module):
    own = events[events["module"] == module]
    speed = np.abs(own["state"][:, 2 + 2 * module] - own["state"][:, 3 + 2 * module])
    return own[["kind", "wall"]][(own["kind"] != IMPACT) | (speed > SLOW)].tolist()


def resting(state):
    """Walls on which the balls of a state rest, or 0."""
    gaps, speeds = state[[0, 2]] - state[[1, 3]], state[[4, 6]] - state[[5, 7]]
    return np.where((np.abs(np.abs(gaps) - 1) < 1e-12) & (speeds == 0), np.sign(gaps), 0).astype(int)


def test_pieces_have_the_events_of_the_whole(pieces):
    whole, runs = pieces
    events = np.concatenate([run.events for run in runs])
    for module in (1, 2):
        assert story(events, module) == story(whole.events, module)
    assert {*whole.events["kind"]} == {IMPACT, STICK, RELEASE}
    np.testing.assert_allclose(runs[-1].final, whole.final, rtol=0, atol=1e-9)
    assert sum(resting(run.start).any() for run in runs) > 2


def test_ensembles_of_pieces_count_as_the_whole_does(pieces):
    whole, runs = pieces
    counted = vi.ensemble(whole.system, START, CYCLES, tau0=whole.begin, energy=True)
    parts = [vi.ensemble(run.system, run.start, 1, tau0=run.begin, energy=True) for run in runs]
    assert counted["sticks"].tolist() == [
        np.sum((whole.events["kind"] == STICK) & (whole.events["module"] == module)) for module in (1, 2)
    ]
    np.testing.assert_array_equal(np.sum([part["sticks"] for part in parts], axis=0), counted["sticks"])
    for part, run in zip(parts, runs, strict=True):
        stuck = run.events[run.events["kind"] == STICK]
        assert part["sticks"].tolist() == [np.sum(stuck["module"] == module) for module in (1, 2)]
    for name in ("mean_square", "ball_speed"):
        np.testing.assert_allclose(np.mean([part[name] for part in parts], axis=0), counted[name], rtol=1e-9)
    np.testing.assert_array_equal(np.max([part["largest"] for part in parts], axis=0) > 0, True)
    for name in ("work", "impacts", "stored"):
        np.testing.assert_allclose(
            np.sum([part["energy"][name] for part in parts], axis=0), counted["energy"][name], rtol=1e-8, atol=1e-12
        )


def test_energies_of_pieces_add_up_to_those_of_the_whole(pieces):
    whole, runs = pieces
    for name in ("work", "impacts", "stored"):
        parts = [getattr(run.energy, name) for run in runs]
        np.testing.assert_allclose(np.sum(parts, axis=0), getattr(whole.energy, name), rtol=1e-8, atol=1e-12)


def test_many_and_copied_runs_list_what_one_lists(pieces):
    for run in pieces[1]:
        (many,) = vi.simulate_many(run.system, [run.start], 1, tau0=run.begin)
        for other in (many, copy.deepcopy(run), pickle.loads(pickle.dumps(run))):
            np.testing.assert_array_equal(other.events, run.events)


def test_the_cuts_are_at_balls_that_rest_on_every_wall():
    """Else the comparisons above would not be about them."""
    finals = [run.final for _, runs in ALL for run in runs]
    found = {(module, int(wall)) for final in finals for module, wall in enumerate(resting(final), 1) if wall}
    assert found == {(1, 1), (1, -1), (2, 1), (2, -1)}


def test_a_start_that_continues_nothing_sticks_at_once():
    """A ball at rest on a wall that pushes it, at any time; with or without a run of no length before."""
    system, state = ALL[0][0].system, next(run.final for run in ALL[0][1] if all(resting(run.final)))
    for tau0 in (2.0, Fraction(2)):
        fresh = vi.simulate(system, state, 1, tau0=tau0)
        assert fresh.events[["tau", "kind"]][:2].tolist() == [(2.0, STICK), (2.0, STICK)]
        assert {*fresh.events["module"][:2]} == {1, 2}
        assert vi.ensemble(system, state, 1, tau0=tau0)["sticks"].tolist() == [
            np.sum((fresh.events["kind"] == STICK) & (fresh.events["module"] == module)) for module in (1, 2)
        ]
        none = vi.simulate(system, state, 0, tau0=tau0)
        rest = vi.simulate(system, state, 1, tau0=none.end)
        assert len(none.events) == 2
        np.testing.assert_array_equal(rest.events, fresh.events[2:])
        np.testing.assert_array_equal(rest.jacobian, fresh.jacobian)
        assert rest.certificate == fresh.certificate


def test_an_impact_at_the_start_that_ends_in_rest_is_one_of_the_run():
    """Continued or not: without a rebound to speak of the ball sticks where it hits."""
    system = ALL[0][0].system.with_(kappa=1e-300)
    state = np.array([-2.5, -3.5, -2.5, -3.5, 0.1, 0.0, 0.0, 0.0])
    listed = [(IMPACT, 1), (STICK, 1), (STICK, 2)]
    end = vi.simulate(system, START, 0).end
    for tau0, expected in ((0.0, listed), (end, listed[:2])):
        run = vi.simulate(system, state, 1, tau0=tau0)
        assert run.events[["kind", "module"]][run.events["tau"] == 0.0].tolist() == expected
        sticks = [np.sum((run.events["kind"] == STICK) & (run.events["module"] == module)) for module in (1, 2)]
        assert vi.ensemble(system, state, 1, tau0=tau0)["sticks"].tolist() == sticks
