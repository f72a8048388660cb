"""The forcing phase at any start and in continued runs agrees with arbitrary precision."""

from fractions import Fraction

import numpy as np
import pytest
from flint import arb, ctx

import vibroimpact as vi
from vibroimpact.accuracy.reference.run import reference_run
from vibroimpact.exact.engine.flow import Instant, advance_phase, phase_at, reduced, sine_and_cosine

START = [0.1, 0.0, 0.2, 0.0, 0.0, 0.3, 0.0, -0.2]


def distance_on_the_circle(phase, omega, offset):
    """Return the distance modulo 2 pi, in turns, between a phase (float, rest) and omega times offset, two floats."""
    with ctx.workprec(4000):
        turns = (arb(phase[0]) + arb(phase[1]) - arb(omega) * arb(offset)) / (2 * arb.pi())
        return float(abs(turns - (turns + 0.5).floor()))


def test_sine_and_cosine_are_accurate_to_a_unit_in_the_last_place():
    rng = np.random.default_rng(0)
    quarters = np.arange(5) * np.pi / 2
    for phase in (*rng.uniform(0, 2 * np.pi, 2000), *quarters, *(quarters + 0.75), *(quarters[1:] - np.pi / 4)):
        tail = float(rng.uniform(-0.5, 0.5) * np.spacing(phase))
        with ctx.workprec(200):
            angle = arb(float(phase)) + arb(tail)
            exact = angle.sin(), angle.cos()
        for found, true in zip(sine_and_cosine(float(phase), tail), exact, strict=True):
            assert abs(float(arb(found) - true)) <= max(np.spacing(abs(found)), 1e-32)


@pytest.mark.parametrize("omega", [1.02, 0.3, 1e5, 1e300, 1e-300])
@pytest.mark.parametrize("tau", [0.0, 0.5, -7.25, 1e16, -1e22, 1e308, 5e-324])
def test_the_phase_of_any_float_is_reduced_exactly(omega, tau):
    phase = phase_at(Instant(Fraction(tau)), omega)
    assert 0.0 <= phase[0] <= 2 * np.pi  # as a float, 2 pi is below its exact value
    assert abs(phase[1]) <= np.spacing(phase[0])
    assert distance_on_the_circle(phase, omega, tau) < 1e-31


def test_the_phase_keeps_its_accuracy_over_many_flights():
    omega, phase, tail = 1.0199999999999998, 0.7, 0.0
    lengths = np.random.default_rng(0).uniform(0, 6, 20_000)
    for t in lengths:
        phase, tail = advance_phase(phase, tail, omega, t)
        if phase >= 2 * np.pi:
            phase, tail = reduced(phase, tail)
    total = sum(map(Fraction, lengths), Fraction(0.7) / Fraction(omega))
    exact = phase_at(Instant(total), omega)
    assert (phase - exact[0]) + (tail - exact[1]) == pytest.approx(0.0, abs=1e-26)


@pytest.mark.parametrize("tau0", [1e6, -1e9, 1e12, Fraction(1, 3), Fraction(10**13, 7)])
def test_a_run_from_any_start_time_ends_in_the_state_of_the_reference(chapter, tau0):
    system = chapter(0.5, 0.5, sigma_e_hat=1.25)  # Omega = 1.125, a float
    run, truth = vi.simulate(system, START, 3, tau0), reference_run(system, START, 3, 40, tau0=Fraction(tau0))
    assert np.abs(run.final - truth.final).max() < 5 * run.certificate.error < 1e-12


@pytest.mark.parametrize("cycles", [7, 1000, 30_000])
def test_a_continued_run_ends_in_the_state_of_one_longer_run(chapter, cycles):
    system, tau0 = chapter(1.0, 1.0), 0.3
    half, whole = vi.simulate(system, START, cycles, tau0), vi.simulate(system, START, 2 * cycles, tau0)
    rest = vi.simulate(system, half.final, cycles, half.end)
    assert phase_at(half.end, system.Omega) == phase_at(half.begin, system.Omega)
    assert np.abs(rest.final - whole.final).max() < 10 * rest.certificate.error < 1e-6
    if cycles >= 1000:  # the motion has settled, so that rounding errors decay
        np.testing.assert_allclose(rest.final, whole.final, rtol=0, atol=1e-14)
    assert rest.end == whole.end
    assert float(whole.end) == pytest.approx(tau0 + 2 * cycles * system.period, rel=1e-15)


def test_the_end_of_a_run_is_an_exact_time_for_other_systems_too(chapter):
    one, other = chapter(sigma_e_hat=1.25), chapter(sigma_e_hat=-5.0)  # Omega = 9/8 and 1/2
    end = vi.simulate(one, START, 9, tau0=0.25).end  # at 1/4 + 16 pi
    assert phase_at(end, other.Omega) == (0.125, 0.0)
    assert float(end) == pytest.approx(0.25 + 16 * np.pi, rel=1e-16)
