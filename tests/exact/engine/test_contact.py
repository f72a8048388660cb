"""Chatter, sticking, release and contact at the start, against closed forms and high precision."""

from fractions import Fraction

import mpmath as mp
import numpy as np
import pytest

import vibroimpact as vi
from vibroimpact.accuracy.reference.run import reference_run
from vibroimpact.exact.engine.contact import impact
from vibroimpact.exact.engine.exclusion import acceleration_rounding
from vibroimpact.exact.engine.flow import flow_of
from vibroimpact.system.state import IMPACT, RELEASE, STICK

QUIET = dict(alpha12_hat=0.0, gamma12_hat=0.0)
ALONE = dict(QUIET, gamma1_hat=0.0, gamma2_hat=0.0)


def swing(x, v, t):
    """Undamped unforced box of unit mass and stiffness in mpmath: position and velocity after t."""
    return x * mp.cos(t) + v * mp.sin(t), v * mp.cos(t) - x * mp.sin(t)


def next_impact(x, v, u):
    """Time to the next impact at wall +1 of a ball leaving it with velocity u: Newton on gap / time."""
    t = 2 * (u - v) / (-x)
    for _ in range(12):
        position, velocity = swing(x, v, t)
        gap, rate = x + u * t - position, u - velocity
        t -= (gap / t) / (rate / t - gap / t**2)
    return t


def chatter_in_high_precision(x, v, u, epsilon, kappa, impacts):
    """(time, X, X', Y') after successive impacts at wall +1 of one undamped unforced module."""
    x, v, u, epsilon, kappa = map(mp.mpf, (x, v, u, epsilon, kappa))
    t, history = mp.mpf(0), []
    for _ in range(impacts):
        flight = next_impact(x, v, u)
        t += flight
        x, v = swing(x, v, flight)
        impulse = (1 + kappa) / (1 + epsilon) * (v - u)
        v, u = v - epsilon * impulse, u + impulse
        history.append((t, x, v, u))
    return history


@pytest.mark.parametrize("kappa", ["0.3", "0.65", "0.9"])
def test_chatter_against_high_precision(chapter, kappa):
    system = chapter(0.0, 0.0, kappa=float(kappa), **ALONE)
    start = np.array([-1.5, -2.5, 0.0, 0.0, 0.0, 0.05, 0.0, 0.0])
    run = vi.simulate(system, start, 1)
    stick = run.events[run.events["kind"] == STICK][0]
    impacts = run.events[(run.events["kind"] == IMPACT) & (run.events["tau"] < stick["tau"])]
    with mp.workdps(80):
        history = chatter_in_high_precision(-1.5, 0, 0.05, "0.1", kappa, int(18 / -np.log10(float(kappa))))
        end, x, v, u = history[-1]
        common = (v + mp.mpf("0.1") * u) / mp.mpf("1.1")
    times = [float(row[0]) for row in history[: len(impacts)]]
    # hops down to speeds of 6e-4 are timed from positions of 1.5 (box) and 2.5 (ball); each error goes on to later hops
    rounding = 4.0 * np.finfo(float).eps / (6e-4 * (1 - float(kappa)))
    np.testing.assert_allclose(impacts["tau"], times, rtol=0, atol=rounding)
    truth = reference_run(system, start, 1, 40).events  # the reference is held to the same
    np.testing.assert_allclose(truth["tau"][: len(times)], times, rtol=1e-15)
    assert truth["tau"][truth["kind"] == STICK][0] == pytest.approx(float(end), rel=1e-15)
    assert stick["tau"] == pytest.approx(float(end), abs=1e-11)
    expected = [float(x), float(x) - 1, 0, 0, float(common), float(common), 0, 0]
    # the stick is reported at its own, slightly approximated instant: compare the states at the same instant
    shift = stick["tau"] - float(end)
    expected = np.array(expected) + shift * np.array([expected[4], expected[4], 0, 0, 1.5, 1.5, 0, 0])
    np.testing.assert_allclose(stick["state"], expected, atol=1e-13)


def test_the_impacts_of_a_chatter_are_listed_under_strong_forces(chapter):
    """Under a push of 1e3 the reference lists 75 impacts with rebounds above 1e-4."""
    system, start = chapter(1e6, 0.0, epsilon=1e-3), [0, -0.999999, 0.2, 0, 0, 0, 0, -0.2]
    events = vi.simulate(system, start, 1, tau0=1.5).events
    truth = reference_run(system, start, 1, 60, tau0=1.5).events
    listed, expected = (np.array([speed for speed in rebounds(run) if speed > 1e-4]) for run in (events, truth))
    assert len(expected) == 75
    np.testing.assert_allclose(listed, expected, rtol=1e-6)


def rebounds(events):
    """Relative speeds just after the impacts."""
    for event in events[events["kind"] == IMPACT]:
        box, ball = event["state"][[2 + 2 * event["module"], 3 + 2 * event["module"]]]
        yield abs(box - ball)


def test_sticking_lasts_until_the_contact_force_vanishes(chapter):
    """Undamped, unforced: box and ball swing as one of mass 1 + epsilon and part at X = 0, in closed form."""
    system = chapter(0.0, 0.0, **ALONE)
    start = np.array([-1.5, -2.5, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0])
    run = vi.simulate(system, start, 1)
    stick, release = run.events[:2]
    assert (stick["kind"], stick["tau"], stick["wall"]) == (STICK, 0.0, 1)
    assert (release["kind"], release["wall"], release["module"]) == (RELEASE, 1, 1)
    assert release["tau"] == pytest.approx(np.pi / 2 * np.sqrt(1.1), abs=1e-15)
    speed = 1.5 / np.sqrt(1.1)
    np.testing.assert_allclose(release["state"], [0, -1, 0, 0, speed, speed, 0, 0], atol=1e-15)


def test_sticks_and_releases_alternate_and_forces_push(chapter, auditor):
    """In the modulated regime every stick ends in a release; its contact force pushes all the way and then vanishes."""
    system = chapter(0.5, 0.5)
    run = vi.simulate(system, [0.1, 0.0, 0.2, 0.0, 0.0, 0.3, 0.0, -0.2], 3000)
    audit = auditor(system)
    sticks = np.flatnonzero(run.events["kind"] == STICK)
    assert len(sticks) >= 10
    for k in sticks:
        stick = run.events[k]
        later = run.events[k + 1 :]
        release = later[(later["module"] == stick["module"]) & (later["kind"] != IMPACT)][0]
        assert release["kind"] == RELEASE
        own, wall = int(stick["module"]) - 1, int(stick["wall"])
        walls = [wall if i == own else 0 for i in range(2)]
        between = later[later["tau"] < release["tau"]]
        if len(between):  # the other module met something meanwhile: audited flight by flight elsewhere
            continue
        span = release["tau"] - stick["tau"]
        forces = []
        for s in np.linspace(0, span, 30):
            state = audit.flow(np.array(stick["state"]), walls, stick["tau"], s)
            forces.append(wall * audit.acceleration(state, walls, stick["tau"] + s)[own])
        assert min(forces[:-1]) > 0
        assert abs(forces[-1]) < 1e-11


def test_impact_law_conserves_momentum_and_never_gains_energy():
    from vibroimpact.system.restitution import after_impact, energy_lost

    rng = np.random.default_rng(0)
    box, ball = rng.normal(size=(2, 1000))
    epsilon, kappa = rng.uniform(0.001, 1, 1000), rng.uniform(0.001, 0.999, 1000)
    new_box, new_ball = after_impact(epsilon, kappa, box, ball)
    np.testing.assert_allclose(new_box + epsilon * new_ball, box + epsilon * ball, atol=1e-14)
    np.testing.assert_allclose(new_box - new_ball, -kappa * (box - ball), atol=1e-14)
    energy = 0.5 * (box**2 + epsilon * ball**2) - 0.5 * (new_box**2 + epsilon * new_ball**2)
    np.testing.assert_allclose(energy, energy_lost(epsilon, kappa, box - ball), atol=1e-14)
    assert (energy_lost(epsilon, kappa, box - ball) >= 0).all()


def test_an_impact_is_rounded_no_more_than_its_velocities_are(chapter):
    """Light balls and heavy ones, against rational numbers."""
    rng = np.random.default_rng(1)
    for _ in range(300):
        epsilon, kappa = 10 ** rng.uniform(-6, 6), rng.uniform(0.001, 0.999)
        q = flow_of(chapter(0.0, 0.0, epsilon=epsilon, kappa=kappa, sigma_e_hat=0.0, **ALONE)).coefficients
        box, ball = rng.normal(size=2)
        e, k, v, u = map(Fraction, (epsilon, kappa, box, ball))
        gained = (1 + k) / (1 + e) * (v - u)
        errors = np.subtract(impact(q, box, ball), (v - e * gained, u + gained))
        assert np.abs(errors).max() < 4 * np.finfo(float).eps * max(abs(box), abs(ball)), (epsilon, kappa, box, ball)


@pytest.mark.parametrize("multiple", [1.2, 1.3, 1.4])
@pytest.mark.parametrize("module", [1, 2])
def test_a_ball_is_held_or_not_by_the_force_on_both(chapter, module, multiple):
    """At rest on its wall under a force that falls, within rounding of none on box and ball, above on the box alone.

    If the two questions were not one, it would stick and be released, then stick again where the run is continued.
    """
    forces = (2.0, 0.0) if module == 1 else (0.0, 2.0)
    system = chapter(*forces, epsilon=0.5, sigma20_hat=0.0, **ALONE)
    speed = 3.0 * system.forcing.max() * system.Omega + 1.0  # the spring soon pulls more
    boxes = (0.0, 0.0, speed, 0.0) if module == 1 else (0.0, 0.0, 0.0, speed)
    place = -multiple * acceleration_rounding(flow_of(system).coefficients, boxes, module - 1)
    start = np.zeros(8)
    start[2 * module - 2 : 2 * module], start[2 * module + 2 : 2 * module + 4] = (place, place - 1.0), speed
    run = vi.simulate(system, start, 1)
    own = run.events[run.events["module"] == module]
    assert own["kind"][0] == IMPACT
