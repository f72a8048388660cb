"""Runs in ensembles have the events of `simulate`, and the statistics of its events and samples."""

import numpy as np
import pytest

import vibroimpact as vi
from attacks import MAX_ERROR_RATIO, ensembles, unlike_single_runs
from vibroimpact.accuracy.reference.run import reference_run
from vibroimpact.exact.engine.event_loop import integrate
from vibroimpact.exact.lanes.ensemble import INADMISSIBLE, MOST_RUNS
from vibroimpact.system.state import BALLS, BOXES

POINTS, WEIGHTS = np.polynomial.legendre.leggauss(20)


def starts(n):
    states = np.random.default_rng(3).uniform(-0.5, 0.5, (n, 8))
    states[:, BALLS[:2]] += states[:, BOXES[:2]]
    return states


def mixed(chapter, n):
    """Return n random systems in wide ranges of parameters."""
    rng = np.random.default_rng(8)
    return [
        chapter(
            epsilon=10.0 ** rng.uniform(-3, 0), kappa=rng.uniform(0.05, 0.95), alpha12_hat=rng.choice([0.0, 1.0, 5.0]),
            gamma1_hat=rng.choice([0.0, 0.2]), gamma2_hat=rng.choice([0.0, 1e-7, 0.2]),
            gamma12_hat=rng.choice([0.0, 0.3]), sigma20_hat=rng.uniform(-0.5, 1.0),
            sigma_e_hat=rng.uniform(0.1, 0.7), f10_hat=rng.uniform(-2, 2), f20_hat=rng.uniform(-2, 2),
        )
        for _ in range(n)
    ]  # fmt: skip


REPEATED = {
    # forces, changes of the chapter's system, start, cycles; each showed a fault of the lanes
    "a polynomial of too low an order in the last fifth of a step": (
        (9.974, -24.43), dict(
            epsilon=0.07825, kappa=0.7236, alpha12_hat=0.9508, gamma1_hat=0.2008, gamma2_hat=0.1993, gamma12_hat=0.1896,
            sigma20_hat=12.78, sigma_e_hat=8.471,
        ), [0.2251, -0.394, -0.9909, -1.575, 0.3667, 0.05323, 0.1308, -0.1263], 10,
    ),
    "rounded entries of the matrix of a step, in hundreds of steps without an impact": (
        (-0.07168, 3.84), dict(
            epsilon=1.486, kappa=0.7927, alpha12_hat=40.63, gamma1_hat=0.02832, gamma2_hat=0.3031, gamma12_hat=0.5076,
            sigma20_hat=1.378, sigma_e_hat=2.093,
        ), [0.325, 0.8211, 0.3438, -0.2701, 0.1695, -0.1961, -0.2541, -0.05388], 9,
    ),
    "rounded places of a slow ball next to a wall, in hundreds of short flights": (
        (0.75, 0.0), dict(
            epsilon=0.25, kappa=0.3, alpha12_hat=0.0, gamma1_hat=0.1, gamma2_hat=0.1, gamma12_hat=0.0, sigma20_hat=1.0,
            sigma_e_hat=5.0,
        ), [0.0, 0.0, 0.0, -1.0 + 1e-12, 0.717, 0.01, 0.0, 1e-7], 8,
    ),
}  # fmt: skip


@pytest.mark.parametrize(("forces", "changes", "start", "cycles"), REPEATED.values(), ids=REPEATED)
def test_errors_that_repeat_in_every_step_or_flight_do_not_add_up(chapter, forces, changes, start, cycles):
    """The true errors of ensembles were once 2.9 to 4.7 times the estimate of the single run."""
    system = chapter(*forces, **changes)
    run, outcome = vi.simulate(system, start, cycles), vi.ensemble(system, start, cycles)
    true = reference_run(system, start, cycles, 40)
    assert run.certificate.decided
    assert outcome["impacts"].sum() == np.count_nonzero(true.events["kind"] == vi.IMPACT)
    assert np.abs(outcome["final"] - true.final).max() < MAX_ERROR_RATIO * run.certificate.error


@pytest.mark.parametrize("seed", [0, 5, 13])
def test_grazing_runs_are_undecided_if_the_steps_of_an_ensemble_decide_differently(seed):
    """From some of these starts, a decided run once had other impacts or another final state than in the ensemble."""
    assert unlike_single_runs(*ensembles["grazing"](np.random.default_rng([seed, 7]), 100)) == []


def test_the_smallest_damping_causes_no_warning(chapter, recwarn):
    system = chapter(
        -0.01, 90.0, epsilon=2.0, alpha12_hat=18.0, gamma1_hat=0.0, gamma2_hat=0.0, gamma12_hat=5e-324,
        sigma20_hat=0.1, sigma_e_hat=5.7,
    )  # fmt: skip
    undamped = vi.ensemble(system.with_(gamma12_hat=0.0), np.zeros(8), 1)
    outcome = vi.ensemble(system, np.zeros(8), 1)
    np.testing.assert_allclose(outcome["mean_square"], undamped["mean_square"], rtol=1e-12)
    assert not recwarn.list


def statistics(system, state, cycles, tau0, settle):
    """Return the statistics of a run, computed from its events and by Gauss's rule on samples in every flight."""
    run = vi.simulate(system, state, cycles, tau0)
    opening, closing = tau0 + settle * system.period, float(run.end)
    events = run.events[run.events["tau"] >= opening]
    # in pieces this short the rule is exact to rounding
    edges = np.unique([*np.arange(opening, closing, 0.3), *events["tau"], closing])
    half = np.diff(edges)[:, None] / 2
    times = edges[:-1, None] + half * (1 + POINTS)
    samples = vi.simulate(system, state, cycles, tau0, times.ravel()).samples.reshape(*times.shape, 8)
    boxes, balls, weights = samples[..., BOXES[:2]], samples[..., BALLS[2:]], half * WEIGHTS / (closing - opening)
    return {
        "impacts": np.bincount(events["module"][events["kind"] == vi.IMPACT], minlength=3)[1:],
        "largest": abs(boxes).max(axis=(0, 1)),
        "mean_square": np.einsum("ij,ijk", weights, boxes**2),
        "ball_speed": np.einsum("ij,ijk", weights, abs(balls)),
    }


@pytest.mark.parametrize("settle", [0, 3])
def test_statistics_and_energies_are_those_of_single_runs(chapter, settle):
    systems, states = mixed(chapter, 12), starts(12)
    outcomes = vi.ensemble(systems, states, 5, 0.4, settle, energy=True)
    for system, state, outcome in zip(systems, states, outcomes, strict=True):
        cycles = vi.simulate(system, state, 5, 0.4).energy.per_cycle[settle:]
        size = sum(np.abs(cycles[name]).sum() for name in cycles.dtype.names)
        for name in cycles.dtype.names:
            np.testing.assert_allclose(outcome["energy"][name], cycles[name].sum(axis=0), rtol=0, atol=1e-12 * size)
        expected = statistics(system, state, 5, 0.4, settle)
        np.testing.assert_array_equal(outcome["impacts"], expected["impacts"])
        np.testing.assert_allclose(outcome["mean_square"], expected["mean_square"], rtol=1e-11)
        # |Y'| of a stuck ball is not smooth
        np.testing.assert_allclose(outcome["ball_speed"], expected["ball_speed"], rtol=1e-3)
        assert (outcome["largest"] >= expected["largest"] * (1 - 1e-15)).all()
        np.testing.assert_allclose(outcome["largest"], expected["largest"], rtol=2e-3)


def test_the_mean_speed_of_a_ball_includes_the_time_in_which_it_sticks(chapter):
    system, state = chapter(f10_hat=0.5, f20_hat=0.5), [-0.8, -1.8, 0.1, 0.1, 0.0, 0.0, 0.0, 0.0]
    (outcome,) = vi.ensemble([system], state, 2)
    events = vi.simulate(system, state, 2).events
    assert (vi.STICK, 1) in events[["kind", "module"]].tolist()
    times = np.unique(np.concatenate([np.linspace(0.0, 2 * system.period, 200_001), events["tau"]]))
    balls = vi.simulate(system, state, 2, sample_times=times).samples[:, BALLS[:2]]
    np.testing.assert_allclose(outcome["ball_speed"], abs(np.diff(balls, axis=0)).sum(axis=0) / times[-1], rtol=1e-8)


def test_the_largest_displacement_is_that_at_the_turn_of_the_box(case):
    """The largest sample is smaller by at most h^2 / 8 times the largest acceleration, which is below 3."""
    state = starts(1)[0]
    (outcome,) = vi.ensemble([case], state, 3)
    grid = np.linspace(0.0, 3 * case.period, 400_001)
    boxes = vi.simulate(case, state, 3, sample_times=np.minimum(grid, 3 * case.period)).samples[:, BOXES[:2]]
    above = outcome["largest"] - abs(boxes).max(axis=0)
    assert (above >= -1e-15).all()
    assert (above <= 3.0 * grid[1] ** 2 / 8).all()


def test_systems_and_starts_are_broadcast_like_arrays(case):
    systems = [case, case.with_(f20_hat=0.3)]
    states = starts(3)
    table = vi.ensemble([[one] for one in systems], states, 2)
    assert table.shape == (2, 3)
    for row, system in enumerate(systems):
        np.testing.assert_array_equal(table[row], vi.ensemble(system, states, 2))
    assert vi.ensemble(systems, states[0], 2).shape == (2,)
    assert vi.ensemble(case, states[0], 2).shape == ()
    assert vi.ensemble(case, np.empty((0, 8)), 2).shape == (0,)
    assert vi.ensemble([], np.empty((0, 8)), 2).shape == (0,)


def test_an_ensemble_with_more_runs_than_one_pass_equals_smaller_ensembles(case):
    states = starts(2 * MOST_RUNS + 300)
    parts = [vi.ensemble(case, states[first : first + 500], 1) for first in range(0, len(states), 500)]
    np.testing.assert_array_equal(vi.ensemble(case, states, 1), np.concatenate(parts))


def test_an_invalid_start_does_not_affect_other_runs(case):
    states = starts(4)
    states[1, 1], states[2, 6] = 9.0, np.nan
    outcomes = vi.ensemble(case, states, 3)
    assert outcomes["status"].tolist() == [0, INADMISSIBLE, INADMISSIBLE, 0]
    assert vi.STATUSES[INADMISSIBLE] == "the start is not finite, or has a ball beyond a wall"
    for name in ("final", "largest", "mean_square", "ball_speed"):
        assert np.isnan(outcomes[name][1:3]).all()
    np.testing.assert_array_equal(outcomes[[0, 3]], vi.ensemble(case, states[[0, 3]], 3))


def test_statistics_are_nan_if_all_cycles_settle(case):
    outcome = vi.ensemble(case, starts(1)[0], 3, settle=3)
    assert np.isfinite(outcome["final"]).all()
    assert np.isnan(outcome["largest"]).all()
    assert not outcome["impacts"].any()


def test_statistics_of_a_periodic_motion_do_not_depend_on_where_the_observation_begins(chapter):
    """The observation begins at an impact, which is just before or just after it by the rounding of times."""
    case = chapter(1.0, 0.89)
    orbit = next(one for one in vi.orbits(case) if one.admissible and max(abs(one.multipliers)) < 1)
    run = vi.simulate(case, orbit.state, 200)
    begun = [(event["state"], 40, event["tau"]) for event in run.events[-4:]]
    outcomes = np.array([[vi.ensemble(case, *begin, settle) for settle in range(1, 39)] for begin in begun])
    assert (outcomes["status"] == 0).all()
    for name in ("largest", "mean_square", "ball_speed"):
        np.testing.assert_allclose(outcomes[name] / outcomes[name][0, 0], 1.0, rtol=1e-9)


@pytest.mark.parametrize("settle", [1, 30])
def test_statistics_after_settling_are_those_of_a_run_from_there(chapter, settle):
    """The whole run is one flight without events, much longer than the flow tables."""
    system = chapter(0.05, 0.0)
    settled = vi.simulate(system, np.zeros(8), settle).final
    found, expected = vi.ensemble(system, np.zeros(8), 40, settle=settle), vi.ensemble(system, settled, 40 - settle)
    assert not found["impacts"].any()
    for name in ("largest", "mean_square", "ball_speed"):
        np.testing.assert_allclose(found[name], expected[name], rtol=1e-10)


def test_simulate_many_gives_the_bits_of_simulate(case, capsys):
    states = starts(17)
    runs = vi.simulate_many(case, states, 60, tau0=0.4, progress=True)
    assert capsys.readouterr().err.endswith("17/17 runs\n")
    assert vi.simulate_many(case, np.empty((0, 8)), 3) == []
    for state, run in zip(states, runs, strict=True):
        single = vi.simulate(case, state, 60, tau0=0.4)
        np.testing.assert_array_equal(run.final, single.final)
        np.testing.assert_array_equal(run.events, single.events)


def test_starts_with_any_memory_layout_compile_nothing_more(case):
    plain, compiled = vi.simulate_many(case, starts(3), 3), list(integrate.signatures)
    for states in (np.asfortranarray(starts(3)), np.repeat(starts(3), 2, axis=0)[::2], starts(3).astype(">f8")):
        runs = vi.simulate_many(case, states, 3)
        np.testing.assert_array_equal([run.final for run in plain], [run.final for run in runs])
    assert integrate.signatures == compiled


def test_the_bits_of_a_run_do_not_depend_on_the_other_runs(chapter, case):
    """The other runs determine the lane of the run, and the pass in which its ball reaches a wall."""
    systems = [*mixed(chapter, 5), case]
    states = starts(60)
    owners = [systems[n % 6] for n in range(60)]
    together = vi.ensemble(owners, states, 20, energy=True)
    alone = [vi.ensemble(system, state, 20, energy=True) for system, state in zip(owners, states, strict=True)]
    assert together.tobytes() == np.stack(alone).tobytes()


@pytest.mark.parametrize("settle", [0, 3])
def test_statistics_by_cycle_add_up_to_those_of_the_whole_run(chapter, settle):
    systems, states = mixed(chapter, 12), starts(12)
    outcomes = vi.ensemble(systems, states, 8, 0.4, settle, by_cycle=True, energy=True)
    assert outcomes.shape == (12, 8 - settle)
    whole = vi.ensemble(systems, states, 8, 0.4, settle, energy=True)
    np.testing.assert_allclose(outcomes["final"][:, -1], whole["final"], rtol=0, atol=1e-9)
    np.testing.assert_array_equal(outcomes["impacts"].sum(axis=1), whole["impacts"])
    for name, over in (("largest", np.max), ("mean_square", np.mean), ("ball_speed", np.mean)):
        np.testing.assert_allclose(over(outcomes[name], axis=1), whole[name], rtol=1e-9)
    for name in ("work", "impacts", "stored"):
        np.testing.assert_allclose(outcomes["energy"][name].sum(axis=1), whole["energy"][name], rtol=1e-9, atol=1e-9)
    assert vi.ensemble(systems, states, 8, 0.4, 8, by_cycle=True).shape == (12, 0)
