"""Ensembles: runs have the events of `simulate`, and their statistics are those of its events and samples."""

import numpy as np
import pytest

import vibroimpact as vi
from attacks import MAX_ERROR_RATIO, ensembles, unlike_single_runs
from hard_starts import example
from vibroimpact.accuracy.reference.run import reference_run
from vibroimpact.exact.engine.event_loop import integrate
from vibroimpact.exact.lanes.ensemble import INADMISSIBLE, MOST_RUNS
from vibroimpact.system.state import BALLS, BOXES

POINTS, WEIGHTS = np.polynomial.legendre.leggauss(20)


def starts(n, seed=3):
    states = np.random.default_rng(seed).uniform(-0.5, 0.5, (n, 8))
    states[:, BALLS[:2]] += states[:, BOXES[:2]]
    return states


def mixed(chapter, n):
    """Systems of very different kinds."""
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


def test_a_thousand_runs_of_mixed_systems_are_those_of_simulate(chapter):
    systems, states = mixed(chapter, 200), starts(1000)
    owners = [systems[n // 5] for n in range(1000)]
    assert unlike_single_runs(owners, states, 12, 0.4) == []


@pytest.mark.parametrize("kind", ensembles)
def test_runs_of_every_scene_are_those_of_simulate(kind):
    rng = np.random.default_rng([3, len(kind)])
    systems, states, cycles, tau0 = ensembles[kind](rng, 60)
    assert unlike_single_runs(systems, states, cycles, tau0) == []


def test_the_order_is_enough_for_velocities(chapter):
    """Impacts in the last fifth of a step show what a polynomial leaves out (4.7 times the estimate with order 14)."""
    system = chapter(
        9.974314351413797, -24.425732101170137, epsilon=0.07825003409352436, kappa=0.7236116545856075,
        alpha12_hat=0.9507573965132918, gamma1_hat=0.20078335412476744, gamma2_hat=0.19929457740366413,
        gamma12_hat=0.189584374040057, sigma20_hat=12.78164479262053, sigma_e_hat=8.470885979620524,
    )  # fmt: skip
    start = [
        0.22513947365076552, -0.39396496754177773, -0.9908861139895444, -1.5751163005554978,
        0.3667377292729382, 0.05322632141505045, 0.13081064865789185, -0.12626233154957594,
    ]  # fmt: skip
    assert error_ratio(system, start, 10) < MAX_ERROR_RATIO


def test_roundings_that_repeat_in_every_step_do_not_add_up(chapter):
    """Hundreds of steps without an impact: rounded entries of their matrix gave 2.9 times the estimate."""
    system = chapter(
        -0.07167641114976606, 3.8396220762427684, epsilon=1.4862053092344494, kappa=0.7926788279848186,
        alpha12_hat=40.63349914929098, gamma1_hat=0.028322338652852004, gamma2_hat=0.30308681273109084,
        gamma12_hat=0.5075912960268201, sigma20_hat=1.3777544643324167, sigma_e_hat=2.093072523678039,
    )  # fmt: skip
    start = [
        0.32495989355551574, 0.8211185444534765, 0.34380572189191405, -0.2701199930059267,
        0.16950600282073186, -0.19608391814989234, -0.254105187216902, -0.05387950388101945,
    ]  # fmt: skip
    assert error_ratio(system, start, 9) < MAX_ERROR_RATIO


def test_roundings_of_a_slow_ball_that_repeat_in_every_flight_do_not_add_up(chapter):
    """Next to a wall it takes hundreds of short flights, as the other box swings: 4.6 times the estimate."""
    system = chapter(
        0.75, 0.0, epsilon=0.25, kappa=0.3, alpha12_hat=0.0, gamma1_hat=0.1, gamma2_hat=0.1, gamma12_hat=0.0,
        sigma20_hat=1.0, sigma_e_hat=5.0,
    )  # fmt: skip
    start = [0.0, 0.0, 0.0, -1.0 + 1e-12, 0.717, 0.01, 0.0, 1e-7]
    assert error_ratio(system, start, 8) < MAX_ERROR_RATIO


def error_ratio(system, start, cycles):
    """True error of an ensemble's final state over the estimate of a single run, the number of impacts being true."""
    run, outcome = vi.simulate(system, start, cycles), vi.ensemble(system, start, cycles)
    assert run.certificate.decided
    true = reference_run(system, start, cycles, 40)
    assert outcome["impacts"].sum() == np.count_nonzero(true.events["kind"] == vi.IMPACT)
    return np.abs(outcome["final"] - true.final).max() / run.certificate.error


@pytest.mark.parametrize("seed", [0, 3, 5, 8, 9, 13, 14])
def test_grazes_that_other_steps_decide_otherwise_are_not_decided(seed):
    """Of these starts a decided run had other impacts than its ensemble, or ended elsewhere."""
    assert unlike_single_runs(*ensembles["grazing"](np.random.default_rng([seed, 7]), 100)) == []


@pytest.mark.parametrize("damping", [1e-300, 1e-308, 5e-324])
def test_the_least_damping_causes_no_warning(chapter, damping, recwarn):
    system = chapter(
        -0.01, 90.0, epsilon=2.0, alpha12_hat=18.0, gamma1_hat=0.0, gamma2_hat=0.0, gamma12_hat=damping,
        sigma20_hat=0.1, sigma_e_hat=5.7,
    )  # fmt: skip
    undamped = vi.ensemble(system.with_(gamma12_hat=0.0), np.zeros(8), 1)
    outcome = vi.ensemble(system, np.zeros(8), 1)
    np.testing.assert_allclose(outcome["mean_square"], undamped["mean_square"], rtol=1e-12)
    assert not recwarn.list


def flights(run, opening):
    """Ends of the flights of a run, cut where observation begins."""
    times = run.events["tau"]
    return np.unique([opening, *times[times > opening], float(run.end)])


def told(system, state, cycles, tau0, settle):
    """What a run amounts to, by its events and by Gauss's rule and a fine grid in every flight."""
    run = vi.simulate(system, state, cycles, tau0)
    opening = tau0 + settle * system.period
    ends = flights(run, opening)
    middle, half = (ends[1:] + ends[:-1]) / 2, (ends[1:] - ends[:-1]) / 2
    pieces = np.ceil(half / 0.2).astype(int)  # short ones: polynomials of degree 39 know them to rounding
    cut = [m + h * np.linspace(-1, 1, k + 1) for m, h, k in zip(middle, half, pieces, strict=True)]
    edges = np.unique(np.concatenate(cut))
    half = np.diff(edges) / 2
    times = ((edges[1:] + edges[:-1]) / 2)[:, None] + half[:, None] * POINTS
    samples = vi.simulate(system, state, cycles, tau0, np.sort(times.ravel())).samples.reshape(*times.shape, 8)
    seconds, weights = ends[-1] - ends[0], half[:, None, None] * WEIGHTS[:, None]
    events = run.events[run.events["tau"] >= opening]
    counts = {kind: [np.sum((events["kind"] == kind) & (events["module"] == m)) for m in (1, 2)] for kind in vi.KINDS}
    boxes, balls = samples[..., BOXES[:2]], samples[..., BALLS[2:]]
    return {
        "impacts": counts[vi.IMPACT],
        "sticks": counts[vi.STICK],
        "largest": abs(boxes).max(axis=(0, 1)),
        "mean_square": (weights * boxes**2).sum(axis=(0, 1)) / seconds,
        "ball_speed": (weights * abs(balls)).sum(axis=(0, 1)) / seconds,
    }


@pytest.mark.parametrize("settle", [0, 3])
def test_what_runs_amount_to(chapter, settle):
    systems, states = mixed(chapter, 12), starts(12)
    outcomes = vi.ensemble(systems, states, 5, 0.4, settle)
    for system, state, outcome in zip(systems, states, outcomes, strict=True):
        expected = told(system, state, 5, 0.4, settle)
        for name in ("impacts", "sticks"):
            np.testing.assert_array_equal(outcome[name], expected[name])
        np.testing.assert_allclose(outcome["mean_square"], expected["mean_square"], rtol=1e-11)
        np.testing.assert_allclose(
            outcome["ball_speed"], expected["ball_speed"], rtol=1e-3
        )  # |Y'| of a stuck ball bends
        assert (outcome["largest"] >= expected["largest"] * (1 - 1e-15)).all()
        np.testing.assert_allclose(outcome["largest"], expected["largest"], rtol=2e-3)


def test_balls_that_stick_travel_with_their_boxes(chapter):
    system, state = chapter(f10_hat=0.5, f20_hat=0.5), [-0.8, -1.8, 0.1, 0.1, 0.0, 0.0, 0.0, 0.0]
    (outcome,) = vi.ensemble([system], state, 2)
    events = vi.simulate(system, state, 2).events["tau"]
    times = np.unique(np.concatenate([np.linspace(0.0, 2 * system.period, 200_001), events]))
    balls = vi.simulate(system, state, 2, sample_times=times).samples[:, BALLS[:2]]
    assert outcome["sticks"][0] >= 1
    np.testing.assert_allclose(outcome["ball_speed"], abs(np.diff(balls, axis=0)).sum(axis=0) / times[-1], rtol=1e-8)


def test_the_largest_excursion_is_where_the_box_turns(case):
    state = starts(1)[0]
    (outcome,) = vi.ensemble([case], state, 3)
    grid = np.linspace(0.0, 3 * case.period, 400_001)
    boxes = vi.simulate(case, state, 3, sample_times=np.minimum(grid, 3 * case.period)).samples[:, BOXES[:2]]
    step, bend = grid[1], 3.0  # |X''| stays below
    above = outcome["largest"] - abs(boxes).max(axis=0)
    assert (above >= -1e-15).all()
    assert (above <= bend * step**2 / 8).all()


def test_hard_starts_are_all_told():
    systems, states, _ = zip(*map(example, range(60)), strict=True)
    outcomes = vi.ensemble(systems, states, 1)
    for system, state, outcome in zip(systems, states, outcomes, strict=True):
        if outcome["status"]:
            with pytest.raises(ArithmeticError, match=vi.STATUSES[outcome["status"]]):
                vi.simulate(system, state, 1)
            assert np.isnan(outcome["final"]).all()
        else:
            assert np.isfinite([*outcome["final"], *outcome["mean_square"]]).all()


def test_systems_and_starts_combine_as_arrays_do(case):
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


def test_many_starts_of_one_system_are_those_of_few(case):
    states = starts(2 * MOST_RUNS + 300)
    parts = [vi.ensemble(case, states[first : first + 500], 1) for first in range(0, len(states), 500)]
    np.testing.assert_array_equal(vi.ensemble(case, states, 1), np.concatenate(parts))


def test_a_start_that_fails_harms_no_other(case):
    states = starts(4)
    states[1, 1], states[2, 6] = 9.0, np.nan
    outcomes = vi.ensemble(case, states, 3)
    assert outcomes["status"].tolist() == [0, INADMISSIBLE, INADMISSIBLE, 0]
    assert vi.STATUSES[INADMISSIBLE] == "the start is not finite, or has a ball beyond a wall"
    for name in ("final", "largest", "mean_square", "ball_speed"):
        assert np.isnan(outcomes[name][1:3]).all()
    np.testing.assert_array_equal(outcomes[[0, 3]], vi.ensemble(case, states[[0, 3]], 3))


def test_nothing_is_observed_when_all_cycles_settle(case):
    outcome = vi.ensemble(case, starts(1)[0], 3, settle=3)
    assert np.isfinite(outcome["final"]).all()
    assert np.isnan(outcome["largest"]).all()
    assert not outcome["impacts"].any()


def test_a_periodic_motion_amounts_to_the_same_from_any_cycle_on_and_from_each_of_its_impacts(chapter):
    """Where observation begins, an impact is just over, just due, or both, by the rounding of times."""
    case = chapter(1.0, 0.89)
    orbit = next(one for one in vi.orbits(case) if one.admissible and max(abs(one.multipliers)) < 1)
    run = vi.simulate(case, orbit.state, 200)
    outcomes = np.stack(
        [
            [vi.ensemble(case, event["state"], 40, event["tau"], settle) for settle in range(1, 39)]
            for event in run.events[-4:]
        ]
    )
    assert (outcomes["status"] == 0).all()
    for name in ("largest", "mean_square", "ball_speed"):
        np.testing.assert_allclose(
            outcomes[name], np.broadcast_to(outcomes[name][0, 0], outcomes[name].shape), rtol=1e-9
        )


@pytest.mark.parametrize("settle", [1, 2, 7, 30])
def test_what_is_seen_from_a_cycle_on_is_what_a_run_from_there_shows(chapter, settle):
    """A flight without an event over the whole run, many times as long as the tables."""
    quiet = chapter(0.05, 0.0)
    late, there = vi.ensemble(quiet, np.zeros(8), 40, settle=settle), vi.simulate(quiet, np.zeros(8), settle).final
    assert not late["impacts"].any()
    anew = vi.ensemble(quiet, there, 40 - settle)
    for name in ("largest", "mean_square", "ball_speed"):
        np.testing.assert_allclose(late[name], anew[name], rtol=1e-10)


def test_many_certified_runs_are_the_single_ones_bit_by_bit(case, capsys):
    states = starts(17)
    runs = vi.simulate_many(case, states, 60, tau0=0.4, progress=True)
    assert capsys.readouterr().err.endswith("17/17 runs\n")
    assert vi.simulate_many(case, np.empty((0, 8)), 3) == []
    for state, run in zip(states, runs, strict=True):
        single = vi.simulate(case, state, 60, tau0=0.4)
        np.testing.assert_array_equal(run.final, single.final)
        np.testing.assert_array_equal(run.events, single.events)


def test_starts_in_any_order_of_memory_run_the_same_code(case):
    plain, compiled = vi.simulate_many(case, starts(3), 3), list(integrate.signatures)
    for states in (np.asfortranarray(starts(3)), np.repeat(starts(3), 2, axis=0)[::2], starts(3).astype(">f8")):
        runs = vi.simulate_many(case, states, 3)
        np.testing.assert_array_equal([run.final for run in plain], [run.final for run in runs])
    assert integrate.signatures == compiled


def test_a_run_does_not_depend_on_its_neighbours(chapter, case):
    """In which lane it is, beside which systems, and in which pass it meets a wall: the same outcome, bit by bit."""
    systems = [*mixed(chapter, 5), case]
    states = starts(60)
    owners = [systems[n % 6] for n in range(60)]
    together = vi.ensemble(owners, states, 20, energy=True)
    alone = [vi.ensemble(system, state, 20, energy=True) for system, state in zip(owners, states, strict=True)]
    assert together.tobytes() == np.stack(alone).tobytes()


@pytest.mark.parametrize("settle", [0, 2])
def test_the_energy_of_a_run_is_that_of_its_events(chapter, settle):
    systems, states = mixed(chapter, 12), starts(12)
    outcomes = vi.ensemble(systems, states, 5, 0.4, settle, energy=True)
    for system, state, outcome in zip(systems, states, outcomes, strict=True):
        cycles = vi.simulate(system, state, 5, 0.4).energy.per_cycle[settle:]
        size = sum(np.abs(cycles[name]).sum() for name in cycles.dtype.names)
        for name in cycles.dtype.names:
            np.testing.assert_allclose(outcome["energy"][name], cycles[name].sum(axis=0), rtol=0, atol=1e-12 * size)


@pytest.mark.parametrize("settle", [0, 3])
def test_cycle_by_cycle_runs_show_what_runs_of_one_cycle_do(chapter, settle):
    systems, states = mixed(chapter, 12), starts(12)
    outcomes = vi.ensemble(systems, states, 8, 0.4, settle, by_cycle=True, energy=True)
    assert outcomes.shape == (12, 8 - settle)
    whole = vi.ensemble(systems, states, 8, 0.4, settle, energy=True)
    np.testing.assert_allclose(outcomes["final"][:, -1], whole["final"], rtol=0, atol=1e-9)
    for name in ("impacts", "sticks"):
        np.testing.assert_array_equal(outcomes[name].sum(axis=1), whole[name])
    for name, over in (("largest", np.max), ("mean_square", np.mean), ("ball_speed", np.mean)):
        np.testing.assert_allclose(over(outcomes[name], axis=1), whole[name], rtol=1e-9)
    for name in ("work", "impacts", "stored"):
        np.testing.assert_allclose(outcomes["energy"][name].sum(axis=1), whole["energy"][name], rtol=1e-9, atol=1e-9)
    assert vi.ensemble(systems, states, 8, 0.4, 8, by_cycle=True).shape == (12, 0)
