"""Periodic orbits of any period agree with closed forms, 1:1 orbits by another method, and long runs."""

import math

import numpy as np
import pytest
from scipy.optimize import brentq

import vibroimpact as vi
from chapter import FORCES, system_of
from single_machines import FIRST, MACHINE

WIDE = 50.0
"""Half the width of the box; the ball never reaches the other wall."""


def hard_oscillator(omega, r, sigma):
    """Return the oscillator x'' + x = cos(omega t) of F. Dux with a fixed wall at sigma, and a state at this wall.

    The wall is a ball at rest with the mass of 1e12 boxes.
    """
    machine = vi.PhysicalSystem.single(M=1, m=1e12, k=1, c=0, F=1, L=WIDE, kappa=r, omega=omega)
    return machine.dimensionless(), np.array([sigma / WIDE, sigma / WIDE - 1, 0, 0, 0, 0, 0, 0])


def one_impact_in(n, omega, r, sigma):
    """Yield impact speeds and forcing phases of motions with one impact in n periods, by Dux's formula."""
    T, gamma, loss = 2 * np.pi * n / omega, 1 / (1 - omega**2), (1 - r) / omega
    c = math.sin(T) * (1 + r) / (1 - math.cos(T)) if abs(math.sin(T)) > 1e-12 else 0.0
    root = np.emath.sqrt((gamma * c) ** 2 - (sigma**2 - gamma**2) * loss**2)
    for v in (2 * (-c * sigma + sign * root) / (c**2 + loss**2) for sign in (1, -1)):
        if np.isreal(v) and v > 0:
            yield v, -np.sign(gamma) * math.acos(min(1.0, (sigma + c * v / 2) / gamma))


def from_impact(omega, r, sigma, n, v, phase):
    """Return the periodic orbit that reaches the wall with speed v at a forcing phase."""
    system, state = hard_oscillator(omega, r, sigma)
    state[4], tau0 = -r * v / WIDE, (phase + np.pi / 2) / omega  # the force is a sine here, a cosine there
    start = system.period * math.ceil(tau0 / system.period)
    return vi.periodic_orbit(system, vi.simulate(system, state, 1, tau0, [start]).samples[0], n)


@pytest.mark.parametrize(
    ("omega", "r", "sigma", "n", "count"),
    [(3.7, 0.8, 0.0, 2, 1), (3.7, 0.8, 0.2, 2, 2), (3.7, 0.8, 0.4, 2, 0), (2.8, 0.8, 0.0, 1, 1)]
    + [(2.0 * n, 0.4, 0.001, n, 1) for n in (1, 2, 5, 10)],
)
def test_the_speed_of_one_impact_in_n_periods_is_that_of_dux_s_formula(omega, r, sigma, n, count):
    candidates = list(one_impact_in(n, omega, r, sigma))
    assert len(candidates) == count
    for v, phase in candidates:
        orbit = from_impact(omega, r, sigma, n, v, phase)
        assert (orbit.periods, orbit.impacts.tolist()) == (n, [[1, 0], [0, 0]])
        assert WIDE * abs(orbit.run.events["state"][0, 4]) / r == pytest.approx(v, rel=1e-9)
        # an impact multiplies the area by r^2; the ball contributes the multipliers of a free flight
        assert np.prod(orbit.multipliers) == pytest.approx(r**2, rel=1e-4)


def test_a_multiplier_grows_without_bound_towards_grazing():
    """On Dux's lower branch the speed v tends to 0 at sigma = gamma; v times the multiplier tends to a constant."""
    speeds, largest = [], []
    for distance in (1e-3, 1e-4, 1e-5):
        sigma = 1 / (3.7**2 - 1) + distance
        *_, (v, phase) = one_impact_in(2, 3.7, 0.8, sigma)
        orbit = from_impact(3.7, 0.8, sigma, 2, v, phase)
        speeds.append(v)
        largest.append(abs(orbit.multipliers[0]))
    assert speeds[0] > 50 * speeds[-1]
    assert largest[-1] > 50 * largest[0] > 50
    assert speeds[1] * largest[1] == pytest.approx(speeds[2] * largest[2], rel=0.02)


def test_grazing_is_reported():
    """At the force f, found by bisection, the ball of a 1:1 motion touches a wall between its impacts."""

    def motion(f10_hat):
        found = [one for one in vi.orbits(MACHINE.with_(f10_hat=f10_hat)) if one.symmetric]
        return max((one for one in found if one.ball_speeds[0, 0] > 0), key=lambda one: one.excursion)

    f = brentq(lambda f: motion(f).excursion - 1, 4.64, 4.66, xtol=1e-13)
    near, clear = (vi.periodic_orbit(one.system, one.state) for one in (motion(f - 1e-9), motion(f - 1e-3)))
    assert "stability=unstable (grazing)" in repr(near)
    assert "(grazing)" not in repr(clear)
    assert clear.run.certificate.nearest_miss == pytest.approx(1 - motion(f - 1e-3).excursion, rel=1e-6)
    with pytest.raises(ValueError, match=r"\Astate: .* no motion with periods=1 near .*; a ball grazes a wall"):
        vi.periodic_orbit(MACHINE.with_(f10_hat=f + 1e-7), motion(f).state)


@pytest.mark.parametrize("case", FORCES)
def test_orbits_with_two_impacts_in_one_period_are_those_of_vi_orbits(case):
    """`vi.orbits` uses superposition of impulse responses."""
    system = system_of(case)
    motions = [orbit for orbit in vi.orbits(system) if orbit.admissible]
    assert motions
    for motion in motions:
        orbit = vi.periodic_orbit(system, motion.state)
        assert np.abs(orbit.state - motion.state).max() < 1e-10
        assert orbit.amplitudes == pytest.approx(motion.amplitudes, rel=1e-9)
        assert np.abs(orbit.multipliers - motion.multipliers).max() < 1e-8 * abs(motion.multipliers[0])
        assert (orbit.symmetric, orbit.stability) == (motion.symmetric, motion.stability)
        assert orbit.impacts.tolist() == [[1, 1], [1, 1]]
        assert orbit.residual < 1e-10


SETTLED = [
    (MACHINE.with_(f10_hat=1.9), 2, [[4, 2], [0, 0]], False),
    (MACHINE.with_(f10_hat=4.9), 4, [[8, 10], [0, 0]], False),
    (FIRST.with_(f10_hat=5.7), 3, [[7, 7], [0, 0]], True),
    (system_of("equal", f10_hat=1.8, f20_hat=1.8), 2, [[2, 4], [4, 2]], False),
    (system_of("equal", f10_hat=3.3, f20_hat=3.3), 5, [[10, 10], [8, 8]], False),
    (system_of("equal", kappa=0.2, f10_hat=3.0, f20_hat=2.7), 1, [[9, 9], [2, 2]], True),  # ball 1 sticks
    (system_of("equal", kappa=0.05, f10_hat=6.0, f20_hat=5.4), 1, [[5, 5], [5, 5]], True),  # both balls stick
]


@pytest.mark.parametrize(("system", "periods", "impacts", "symmetric"), SETTLED)
def test_the_orbit_near_a_settled_run_has_its_period_impacts_and_amplitudes(system, periods, impacts, symmetric):
    """The search starts at a distance from the settled motion."""
    settled = vi.simulate(system, np.zeros(8), 3000).final
    push = np.array([3e-4, 0, -2e-4, 0, 1e-4, 0, 2e-4, 0])
    orbit = vi.periodic_orbit(system, settled + push * np.isin([1, 1, 2, 2] * 2, system.modules), periods)
    assert np.abs(orbit.state - settled).max() < 1e-11
    assert (orbit.periods, orbit.impacts.tolist(), orbit.symmetric) == (periods, impacts, symmetric)
    assert orbit.period == periods * system.period
    assert orbit.stability == "stable"
    assert orbit.residual < 1e-12
    run = vi.simulate(system, settled, periods, sample_times=np.linspace(0, orbit.period, 20_001))
    moving = np.array(system.modules) - 1
    assert orbit.amplitudes[moving] == pytest.approx(np.abs(run.samples[:, [0, 2]]).max(axis=0)[moving], rel=1e-6)
    assert np.isnan(orbit.amplitudes).sum() == 2 - len(moving)


def test_the_unstable_orbit_of_half_the_period_is_found_near_a_period_doubled_motion():
    system = MACHINE.with_(f10_hat=1.9)
    state = vi.simulate(system, np.zeros(8), 3000).final
    once = vi.periodic_orbit(system, state)
    assert once.stability == "unstable"
    assert once.multipliers[0].real < -1
    with pytest.raises(ValueError, match=r"\Aperiods: got 4, but the motion already repeats after 2\Z"):
        vi.periodic_orbit(system, state, 4)


def test_an_orbit_without_impacts_is_that_of_a_linear_oscillator():
    """The ball rests anywhere between the walls, and has two multipliers of 1."""
    system = MACHINE.with_(f10_hat=0.1)
    orbit = vi.periodic_orbit(system, np.zeros(8))
    assert orbit.impacts.sum() == 0
    assert orbit.multipliers[:2] == pytest.approx(1)
    decay = np.exp(-system.gamma1 * system.period / 2)
    assert abs(orbit.multipliers[2:]) == pytest.approx(decay, rel=1e-12)
    assert orbit.stability == "undecided"
    response = system.forcing[0] / abs(1 - system.Omega**2 + 1j * system.gamma1 * system.Omega)
    assert orbit.amplitudes[0] == pytest.approx(response, rel=1e-12)


@pytest.mark.parametrize("f10_hat", [0.05, 0.1])
def test_balls_without_impacts_are_at_rest_in_the_periodic_orbit(f10_hat):
    """In one of the starts a ball drifts to a wall in the first period."""
    system = system_of("equal", f10_hat=f10_hat, f20_hat=f10_hat)
    for ball in (0.02, -0.1, 0.3):
        orbit = vi.periodic_orbit(system, [0.01, 0.2, 0, -0.5, 0.1, ball, 0, -ball], 1)
        assert np.abs(vi.simulate(system, orbit.state, 3).final - orbit.state).max() < 1e-12
        assert orbit.impacts.sum() == 0
        assert orbit.stability == "undecided"
        response = vi.periodic_orbit(system, np.zeros(8)).amplitudes
        assert orbit.amplitudes == pytest.approx(response, abs=1e-12)


def test_the_period_of_a_strongly_unstable_motion_is_recognised():
    """A multiplier of 382 loses five of sixteen digits in two periods."""
    system = system_of("equal")
    motion = max((one for one in vi.orbits(system) if one.admissible), key=lambda one: abs(one.multipliers[0]))
    assert abs(motion.multipliers[0]) > 100
    for periods in (2, 3):
        with pytest.raises(ValueError, match=rf"\Aperiods: got {periods}, but the motion already repeats after 1\Z"):
            vi.periodic_orbit(system, motion.state, periods)


def test_a_start_from_which_no_orbit_is_found_is_an_error():
    system = system_of("equal", kappa=0.2, f20_hat=0.9)
    text = r"\Astate: .* no motion with periods=1 near .* the states at both ends of the motion differ"
    with pytest.raises(ValueError, match=text):
        vi.periodic_orbit(system, vi.simulate(system, np.zeros(8), 2000).final)
