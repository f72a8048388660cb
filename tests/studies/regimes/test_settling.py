"""Names of aperiodic motions agree with constructed evidence, known motions and longer runs."""

from collections import Counter
from dataclasses import replace
from itertools import product

import numpy as np
import pytest

import vibroimpact as vi
from vibroimpact.exact.lanes.ensemble import finals
from vibroimpact.exact.measures.periodicity import distance_after
from vibroimpact.studies.regimes import aperiodic
from vibroimpact.studies.regimes import classification as names
from vibroimpact.studies.regimes.classification import classify_after, starts
from vibroimpact.studies.regimes.lyapunov import Measured
from vibroimpact.studies.regimes.midpoint_grid import centres
from vibroimpact.studies.regimes.settling import settle

ENDS = {*names.PERIODIC, names.IDLE, names.NO_IMPACTS}


@pytest.mark.parametrize(
    ("mean", "error", "expected"),
    [
        (0.5, 0.1, aperiodic.POSITIVE),
        (0.5, 0.2, aperiodic.OPEN),
        (0.001, 0.001, aperiodic.ZERO),
        (-0.001, 0.001, aperiodic.ZERO),
        (0.01, 0.02, aperiodic.OPEN),
        (-0.012, 0.0001, aperiodic.OPEN),  # a periodic motion that is not reached yet
    ],
)
def test_the_sign_of_an_exponent_is_open_if_its_error_is_too_large(mean, error, expected):
    found = Measured(mean, error)
    found.scatter = error
    assert aperiodic.sign(found) == expected


def test_linear_growth_of_perturbations_leaves_the_sign_open(chapter):
    """For balls at rest, the exponent over cycles 20 to 140 is ln(140 / 20) / 120 = 0.016, with little scatter."""
    found = vi.largest_lyapunov(chapter(0.02, 0.02), np.zeros(8), 120, 0, 6, 1)
    assert found.mean == pytest.approx(np.log(7) / 120, rel=0.1)
    assert found.mean > 3 * found.scatter > 0
    assert aperiodic.sign(found) == aperiodic.OPEN


@pytest.mark.parametrize(
    ("shares", "expected"),
    [
        ((0.0, 0.05), aperiodic.NEVER),
        ((0.6, 0.05), aperiodic.AT_TIMES),
        ((1.0, 0.5), aperiodic.AT_TIMES),
        ((1.0, 0.95), aperiodic.ALWAYS),
        ((1.0, 0.0), aperiodic.ALWAYS),
    ],
)
def test_resonance_follows_from_the_share_of_resonant_time_of_each_module(shares, expected):
    assert aperiodic.resonance(shares) == expected


def ends(chapter, f10, f20, observation, count=5):
    return [regime.name for regime in settle(chapter(f10, f20), starts(count, seed=1), observation)]


def test_unforced_motions_are_at_rest_or_unsettled(chapter, observation):
    """Energy decays ever more slowly, and the decaying motion does not recur."""
    assert ends(chapter, 0.0, 0.0, observation) == [names.NO_IMPACTS] + 4 * [names.UNSETTLED]
    decaying = vi.simulate(chapter(0.0, 0.0), starts(2, seed=1)[1], 1000)
    assert not aperiodic.recurs(chapter(0.0, 0.0), decaying.final, 1000)


def test_balls_hop_at_weak_forces(chapter, observation):
    system = chapter(0.03, 0.03)
    regimes = settle(system, starts(4, seed=1)[1:], observation)
    assert {regime.name for regime in regimes} == {names.HOPPING}
    run = vi.simulate(system, regimes[0].run.final, 2000)
    assert len(run.events) / run.cycles < 1.5


def test_a_torus_is_quasi_periodic(chapter, observation):
    """The force is just below the Neimark-Sacker point of the asymmetric pair, and the start is near the pair."""
    pair = [o for o in vi.orbits(chapter(1.0, 0.8181)) if not o.symmetric and abs(o.multipliers[0]) < 1]
    near = pair[0].state + 1e-3 * np.eye(8)[4]
    assert [r.name for r in settle(chapter(1.0, 0.8168), [near], observation)] == [names.QUASI_PERIODIC]
    assert [r.name for r in settle(chapter(1.0, 0.8181), [near], observation)] == [names.ASYMMETRIC]


def names_now_and_later(system, states, observation, times):
    """Return the number of starts for each pair (name, name after a run `times` as long as all rounds).

    The longer runs begin at the starts and do not use Newton's method. A periodic motion keeps its name if the longer
    run repeats to 1e-4 after the same number of cycles: the slowest spirals repeat to 1e-8 only after 100 000 cycles.
    """
    regimes, counts = settle(system, states, observation), Counter()
    late = finals(system, states, times * observation.cycles * observation.rounds)
    for one, state in zip(regimes, late, strict=True):
        times = np.arange(2 * observation.cycles + 1) * (system.period / 2)
        run = vi.simulate(system, state, observation.cycles, sample_times=times)
        name = names.classify(run)[0]
        if name == names.UNSETTLED and one.repeats and distance_after(run.samples[:, :4], 2, one.repeats) < 1e-4:
            name = one.name
        if name == names.UNSETTLED:
            name = aperiodic.name_aperiodic(run, observation.blocks, observation.block)
        counts[one.name, name] += 1
    return counts


@pytest.mark.thorough
def test_names_remain_in_runs_fifty_times_as_long(chapter, observation):
    """Repeat the test of docs/studies/regimes.md on a smaller map."""
    counts = Counter()
    for f10, f20 in product(centres((0.0, 1.6), 4), repeat=2):
        counts += names_now_and_later(chapter(f10, f20), starts(4, seed=4), observation, times=50)
    assert counts.total() == 64
    settled = {(name, later): n for (name, later), n in counts.items() if name != names.UNSETTLED}
    assert {later for (name, later) in settled if name in ENDS} <= ENDS
    assert all(name == later for name, later in settled if name not in names.CHAOS)
    chaotic = sum(n for (name, _), n in settled.items() if name in names.CHAOS)
    kept = sum(n for (name, later), n in settled.items() if name in names.CHAOS and later in names.CHAOS)
    assert kept >= 0.95 * chaotic > 20
    assert counts[names.STRONGLY_MODULATED, names.STRONGLY_MODULATED] > 15


def test_transient_chaos_is_not_called_chaotic_after_a_long_retest(chapter, observation):
    """At forces (1, 0.97), chaos lasts for about 1600 cycles, longer than the short retest."""
    system, states = chapter(1.0, 0.97), starts(12, seed=1)
    short = [r.name for r in settle(system, states, replace(observation, rounds=1, retest=1))]
    long = [r.name for r in settle(system, states, replace(observation, rounds=1))]
    assert set(short) & set(names.CHAOS)
    assert set(long) <= {names.ASYMMETRIC, names.UNSETTLED}


def test_chaos_of_the_first_module_from_rest_at_weak_forces_ends(chapter, observation):
    """Ball 2 stays at rest. From at least two of the starts, module 1 finally repeats every cycle."""
    system = chapter(0.5, 0.5)
    states = np.zeros((10, 8))
    states[:, 4] = 1e-6 * np.arange(10)
    ended = 0
    for state in states:
        run = vi.simulate(system, state, 60000)
        assert not (run.events["module"] == 2).any()
        ended += classify_after(system, run.final, observation.window, observation.nearness).repeats == 1
    assert ended >= 2
