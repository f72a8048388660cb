"""Many runs at once are the single runs, bit by bit."""

import numpy as np
import pytest

import vibroimpact as vi
from vibroimpact.exact.engine.event_loop import integrate


def starts(n):
    states = np.random.default_rng(3).uniform(-0.5, 0.5, (n, 8))
    states[:, [1, 3]] += states[:, [0, 2]]
    return states


def test_bit_equal_to_single_runs(case):
    states = starts(17)
    runs = vi.simulate_many(case, states, 60, tau0=0.4)
    assert len(runs) == 17
    for state, run in zip(states, runs, strict=True):
        single = vi.simulate(case, state, 60, tau0=0.4)
        np.testing.assert_array_equal(run.final, single.final)
        np.testing.assert_array_equal(run.events, single.events)


def test_starts_in_any_order_of_memory_run_the_same_code(case):
    plain = vi.simulate_many(case, starts(3), 3)
    compiled = list(integrate.signatures)
    for states in (np.asfortranarray(starts(3)), starts(6)[::2], starts(3).astype(">f8")):
        runs = vi.simulate_many(case, states, 3)
        assert len(runs) == 3
    assert integrate.signatures == compiled
    for run, other in zip(plain, vi.simulate_many(case, np.asfortranarray(starts(3)), 3), strict=True):
        np.testing.assert_array_equal(run.final, other.final)


def test_progress_is_reported(case, capsys):
    vi.simulate_many(case, starts(5), 3, progress=True)
    assert capsys.readouterr().err.endswith("5/5 runs\n")


def test_no_states(case):
    assert vi.simulate_many(case, np.empty((0, 8)), 3) == []


def test_bad_states_are_named(case):
    with pytest.raises(ValueError, match=r"states: needs shape \(n, 8\), got \(8,\)"):
        vi.simulate_many(case, np.zeros(8), 3)
    states = np.zeros((3, 8))
    states[2, 3] = 1.5
    with pytest.raises(ValueError, match=r"states\[2\]: state: \|X2 - Y2\| = 1.5 is above 1"):
        vi.simulate_many(case, states, 3)
    with pytest.raises(ValueError, match="cycles: -2 is not a whole number"):
        vi.simulate_many(case, states[:2], -2)
