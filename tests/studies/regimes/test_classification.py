"""Regimes agree with exact orbits and their multipliers, closed forms, longer runs and symmetry."""

import numpy as np
import pytest

import vibroimpact as vi
from vibroimpact.exact.lanes.ensemble import finals
from vibroimpact.studies.regimes import classification as names
from vibroimpact.studies.regimes.classification import classify_after, starts
from vibroimpact.studies.regimes.settling import settle
from vibroimpact.system.matrices import dynamic_stiffness


def stable_orbits(system):
    return [orbit for orbit in vi.orbits(system) if orbit.admissible and abs(orbit.multipliers[0]) < 1]


def test_equal_forces_lead_to_the_stable_asymmetric_orbits(chapter, observation):
    system = chapter()
    regimes = settle(system, starts(12, seed=3), observation)
    assert {regime.name for regime in regimes} == {names.ASYMMETRIC}
    orbits = stable_orbits(system)
    for regime in regimes:
        assert min(np.abs(regime.run.final - orbit.state).max() for orbit in orbits) < 1e-9
        np.testing.assert_allclose(regime.mean_amplitudes, orbits[0].C, rtol=0.02)
    assert {np.sign(regime.flight_asymmetry) for regime in regimes} == {1, -1}


def test_flight_asymmetry_is_the_difference_of_flight_times_summed_over_modules(chapter):
    """Impact phases of the exact orbit give the time from wall -1 to wall +1 minus the time back, for each module."""
    system, window = chapter(), 24
    for orbit in stable_orbits(system):
        regime, expected = classify_after(system, orbit.state, window, 0.02), 0.0
        for module, (plus, minus) in enumerate(orbit.impact_phases, start=1):
            walls = regime.impacts["wall"][regime.impacts["module"] == module][:-1]  # the last flight is not over
            flights = {1: (minus - plus) % 1.0, -1: (plus - minus) % 1.0}
            expected -= sum(wall * flights[wall] for wall in walls) / window
        assert regime.flight_asymmetry == pytest.approx(expected, abs=1e-9)


@pytest.mark.parametrize(("f10", "f20", "name"), [(1.3, 1.25, names.SYMMETRIC), (1.0, 1.2, names.ASYMMETRIC)])
def test_an_exact_stable_orbit_is_recognised(chapter, f10, f20, name):
    system = chapter(f10, f20)
    orbits = stable_orbits(system)
    assert orbits
    for orbit in orbits:
        assert orbit.symmetric == (name == names.SYMMETRIC)
        assert classify_after(system, orbit.state, 24, 0.02).name == name
        regime = classify_after(system, orbit.state + 1e-4, 24, 0.02)
        assert min(np.abs(regime.run.start - one.state).max() for one in orbits) < 1e-9


def test_a_run_from_an_unstable_orbit_is_unsettled(chapter):
    system = chapter()
    for orbit in vi.orbits(system):
        if orbit.admissible and abs(orbit.multipliers[0]) > 1.5:
            assert classify_after(system, orbit.state, 12, 0.02).name == names.UNSETTLED


def test_weak_forces_lead_to_modulation_and_from_rest_to_an_idle_ball(chapter, observation):
    system = chapter(0.5, 0.5)
    rest, *others = settle(system, starts(10, seed=4), observation)
    assert rest.name == names.IDLE
    assert not rest.impacts["module"].tolist().count(2)
    assert not rest.run.samples[:, [3, 7]].any()
    assert {regime.name for regime in others} == {names.STRONGLY_MODULATED}


def test_without_impacts_the_boxes_follow_the_linear_response(chapter, observation):
    system = chapter(0.05, 0.05)
    assert abs(np.linalg.solve(dynamic_stiffness(system), system.forcing.astype(complex))).max() < 0.9
    regime = settle(system, np.zeros((1, 8)), observation)[0]
    assert regime.name == names.NO_IMPACTS
    assert regime.mean_amplitudes.tolist() == [0, 0]


def test_drifting_balls_are_unsettled_even_without_an_impact_in_the_window(chapter):
    """At a speed of 1e-5, a ball needs more than 10 000 cycles to reach a wall."""
    system = chapter(0.05, 0.05)
    settled = vi.simulate(system, np.zeros(8), 300).final.copy()
    assert classify_after(system, settled, 24, 0.02).name == names.NO_IMPACTS
    settled[5] = 1e-5
    drifting = classify_after(system, settled, 24, 0.02)
    assert not len(drifting.run.events)
    assert drifting.name == names.IDLE  # the other ball is at rest
    settled[7] = 1e-5
    assert classify_after(system, settled, 24, 0.02).name == names.UNSETTLED


def test_other_periodic_motions_repeat(chapter, observation):
    system = chapter(0.3, 1.4)
    regimes = settle(system, starts(6, seed=1)[1:], observation)
    periodic = [regime for regime in regimes if regime.name == names.OTHER]
    assert periodic
    for regime in periodic:
        later = vi.simulate(system, regime.run.final, regime.repeats)
        np.testing.assert_allclose(later.final, regime.run.final, atol=1e-8)


@pytest.fixture(scope="module")
def narrow(chapter):
    """Return a system with narrow chaos at a distance of 0.02 from an attracting motion of two cycles."""
    return chapter(1.5, 1.5, kappa=0.3)


def test_narrow_chaos_near_an_attracting_motion_is_not_called_periodic(narrow, observation):
    """After 10 000 cycles, the largest Lyapunov exponent is still positive."""
    states = starts(12, seed=3)[[0, 2]]
    assert {regime.name for regime in settle(narrow, states, observation)} <= set(names.CHAOS)
    for state in finals(narrow, states, 10_000):
        exponent = vi.largest_lyapunov(narrow, state, cycles=1000, settle=0)
        assert exponent.mean > 5 * exponent.error


@pytest.mark.parametrize(("nudge", "reached"), [(1e-6, True), (3e-4, True), (5e-3, False), (1e-2, False)])
def test_a_run_is_periodic_if_it_approaches_the_motion(narrow, nudge, reached):
    """Starts are near the motion of two cycles. The expected results are those of runs over 1000 cycles."""
    motion = vi.periodic_orbit(narrow, [-0.64, 0.358, -0.624, -0.229, -0.75, -0.769, -0.478, -1.126], 2)
    state = motion.state + nudge * np.eye(8)[0]
    later = vi.simulate(narrow, state, 1000).final
    assert (np.abs(later - motion.state).max() < 1e-9) == reached
    assert (classify_after(narrow, state, 24, 0.02).name == names.OTHER) == reached
