"""Mean lives: on made-up exponential lives, and on the chaos next to its crisis by another way of seeing its end."""

import numpy as np
import pytest

import vibroimpact as vi
from vibroimpact.regimes.classification import starts
from vibroimpact.regimes.lifetimes import Lifetime, bracket, lifetime


def watched(lives, step, longest):
    """What is seen of lives that are looked at every `step` cycles, up to `longest`."""
    ends = np.ceil(lives / step)
    last = longest // step
    return Lifetime(int((ends <= last).sum()), int(np.minimum(ends, last).sum()), step)


@pytest.mark.parametrize("mean", [100.0, 700.0, 30000.0])
def test_made_up_lives_are_estimated_within_their_error(mean):
    random = np.random.default_rng(1)
    found = [watched(random.exponential(mean, 100), step=250, longest=5000) for _ in range(200)]
    seen = [f for f in found if 0 < f.escapes < f.trials]
    scores = np.array([(f.mean - mean) / f.error for f in seen])
    assert len(scores) > 150
    assert abs(np.median([f.mean for f in seen]) / mean - 1) < 0.05
    assert 0.7 < scores.std() < 1.6


def test_without_escapes_there_is_a_lower_bound():
    """With a mean life at the bound, nothing would be seen to escape in one case of twenty."""
    found = Lifetime(0, 400, 250)
    assert found.mean == np.inf
    assert np.exp(-found.total / found.least) == pytest.approx(0.05)
    assert np.isnan(Lifetime(1, 400, 250).least)


def test_lives_that_all_end_within_a_step_have_no_estimate():
    assert np.isnan(Lifetime(17, 17, 250).mean)
    assert np.isnan(Lifetime(17, 17, 250).error)


def test_the_bracket_of_the_crisis():
    assert bracket([0.9, 0.95, 0.96, 1.0], [0, 0, 3, 9]) == (0.95, 0.96)
    assert np.isnan(bracket([0.9, 0.95], [0, 0])[1])
    assert np.isnan(bracket([0.99, 1.0], [4, 5])[0])


def test_the_life_at_equal_amplitudes_by_the_distance_to_the_exact_orbits(chapter):
    """The end of a life is seen here as coming within 0.1 of the state of a stable orbit, cycle by cycle."""
    system, step = chapter(1.0, 0.98), 250
    found = lifetime(system, starts(60, seed=3), step, step, 5000, window=24, nearness=0.02)
    stable = [orbit.state for orbit in vi.orbits(system) if orbit.admissible and abs(orbit.multipliers[0]) < 1]
    times = np.arange(5001) * system.period
    lives = []
    for run in (vi.simulate(system, state, 5000, sample_times=times) for state in starts(60, seed=5)):
        distance = min(np.abs(run.samples[-1] - state).max() for state in stable)
        assert distance < 1e-3
        away = np.min([np.abs(run.samples - state).max(axis=1) for state in stable], axis=0) > 0.1
        lives.append(np.flatnonzero(away)[-1])
    late = np.array([life - step for life in lives if life > step])
    other = late.mean()
    assert abs(found.mean - other) < 4 * np.hypot(found.error, other / np.sqrt(len(late)))


def test_no_life_ends_where_nothing_periodic_attracts(chapter):
    found = lifetime(chapter(0.5, 0.5), starts(5, seed=1)[1:], 250, 250, 2000, window=24, nearness=0.02)
    assert (found.escapes, found.total) == (0, 4 * 1750)
