"""Chatter, impacts and contact at the start agree with high precision and rational arithmetic."""

from fractions import Fraction

import mpmath as mp
import numpy as np
import pytest

import vibroimpact as vi
from attacks import rebound_speeds
from vibroimpact.accuracy.reference.run import reference_run
from vibroimpact.exact.engine.contact import impact
from vibroimpact.exact.engine.exclusion import acceleration_rounding
from vibroimpact.exact.engine.flow import SCALARS, Coefficients, flow_of, numbers_of
from vibroimpact.system.state import IMPACT, STICK

ALONE = dict(alpha12_hat=0.0, gamma12_hat=0.0, gamma1_hat=0.0, gamma2_hat=0.0)


def chatter(x, v, u, kappa, impacts):
    """Return times of impacts at wall +1 of one undamped unforced module, by Newton's method on gap / time."""
    x, v, u, kappa, t, times = *map(mp.mpf, (x, v, u, kappa)), mp.mpf(0), []
    for _ in range(impacts):
        hop = 2 * (u - v) / (-x)
        for _ in range(12):
            position, velocity = x * mp.cos(hop) + v * mp.sin(hop), v * mp.cos(hop) - x * mp.sin(hop)
            gap, rate = x + u * hop - position, u - velocity
            hop -= (gap / hop) / (rate / hop - gap / hop**2)
        impulse = (1 + kappa) / mp.mpf("1.1") * (velocity - u)
        t, x, v, u = t + hop, position, velocity - mp.mpf("0.1") * impulse, u + impulse
        times.append(t)
    return np.array(times, float)


@pytest.mark.parametrize("kappa", ["0.3", "0.65", "0.9"])
def test_times_of_a_chatter_agree_with_high_precision(chapter, kappa):
    """The times of the reference, with which other tests compare chatters, agree too."""
    system, start = chapter(0.0, 0.0, kappa=float(kappa), **ALONE), [-1.5, -2.5, 0.0, 0.0, 0.0, 0.05, 0.0, 0.0]
    events, truth = vi.simulate(system, start, 1).events, reference_run(system, start, 1, 40).events
    stick, true_stick = (found["tau"][found["kind"] == STICK][0] for found in (events, truth))
    impacts = events["tau"][(events["kind"] == IMPACT) & (events["tau"] < stick)]
    with mp.workdps(80):
        times = chatter(-1.5, 0, 0.05, kappa, int(18 / -np.log10(float(kappa))))
    # times of hops with speeds from 6e-4 follow from positions of 1.5 (box) and 2.5 (ball); errors pass to later hops
    rounding = 4.0 * np.finfo(float).eps / (6e-4 * (1 - float(kappa)))
    np.testing.assert_allclose(impacts, times[: len(impacts)], rtol=0, atol=rounding)
    np.testing.assert_allclose(truth["tau"][: len(impacts)], times[: len(impacts)], rtol=1e-15)
    assert true_stick == pytest.approx(times[-1], rel=1e-15)
    assert stick == pytest.approx(times[-1], abs=1e-11)


def test_a_chatter_under_strong_forces_lists_the_impacts_of_the_reference(chapter):
    """At a contact force of 1e3 the reference lists 75 impacts with rebounds above 1e-4."""
    system, start = chapter(1e6, 0.0, epsilon=1e-3), [0, -0.999999, 0.2, 0, 0, 0, 0, -0.2]
    events = vi.simulate(system, start, 1, tau0=1.5).events
    truth = reference_run(system, start, 1, 60, tau0=1.5).events
    speeds = (rebound_speeds(listed[listed["kind"] == IMPACT]) for listed in (events, truth))
    listed, expected = (one[one > 1e-4] for one in speeds)
    assert len(expected) == 75
    np.testing.assert_allclose(listed, expected, rtol=1e-6)


def test_the_rounding_error_of_an_impact_is_below_four_roundings_of_its_velocities(chapter):
    """Light and heavy balls are compared with rational arithmetic."""
    rng = np.random.default_rng(1)
    drawn = [dict(epsilon=10 ** rng.uniform(-6, 6), kappa=rng.uniform(0.001, 0.999)) for _ in range(300)]
    numbers, _ = numbers_of([chapter(0.0, 0.0, sigma_e_hat=0.0, **ALONE, **one) for one in drawn], 2)
    for one, row in zip(drawn, numbers, strict=True):
        box, ball = rng.normal(size=2)
        e, k, v, u = map(Fraction, (*one.values(), box, ball))
        gained = (1 + k) / (1 + e) * (v - u)
        errors = np.subtract(impact(Coefficients(*row[:SCALARS]), box, ball), (v - e * gained, u + gained))
        assert np.abs(errors).max() < 4 * np.finfo(float).eps * max(abs(box), abs(ball)), (one, box, ball)


@pytest.mark.parametrize("module", [1, 2])
def test_stick_and_release_depend_on_the_same_contact_force(chapter, module):
    """A ball at rest on its wall does not stick if the force on box and ball is zero within rounding and decreases.

    If the start tested the force on the box alone, the ball would stick, be released, and stick again in a continued
    run.
    """
    forces = (2.0, 0.0) if module == 1 else (0.0, 2.0)
    system = chapter(*forces, epsilon=0.5, sigma20_hat=0.0, **ALONE)
    speed = 3.0 * system.forcing.max() * system.Omega + 1.0  # the spring soon pulls more
    boxes = (0.0, 0.0, speed, 0.0) if module == 1 else (0.0, 0.0, 0.0, speed)
    place = -1.3 * acceleration_rounding(flow_of(system).coefficients, boxes, module - 1)
    start = np.zeros(8)
    start[2 * module - 2 : 2 * module], start[2 * module + 2 : 2 * module + 4] = (place, place - 1.0), speed
    run = vi.simulate(system, start, 1)
    own = run.events[run.events["module"] == module]
    assert own["kind"][0] == IMPACT
