"""Linear references agree with integration of the forces written out by hand, and with closed forms of the textbook."""

import math

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.optimize import brentq

import vibroimpact as vi
from chapter import PARAMETERS
from vibroimpact.studies.absorbers.references import Tuning, best_tuning, textbook_tuning, tuned, without_balls

CHAPTER = vi.System(**PARAMETERS, f10_hat=1.0, f20_hat=1.0)
DAMPED = vi.System(**{**PARAMETERS, "gamma1_hat": 2.5, "gamma2_hat": 3.5}, f10_hat=1.0, f20_hat=-0.6)
TUNING = Tuning((0.95, 1.1), (0.2, 0.3))
BARE = dict.fromkeys(("alpha12_hat", "gamma1_hat", "gamma2_hat", "gamma12_hat", "sigma20_hat"), 0.0)


def hosts(**changes):
    """Return a system of two identical boxes, undamped and uncoupled."""
    return vi.System(**{**PARAMETERS, **BARE, **changes}, f10_hat=1.0, f20_hat=1.0)


def by_hand(system, tuning=None):
    """Return the time derivative of [X1, X2, Y1, Y2, velocities] as a function; forces are summed one by one."""
    e = system.epsilon

    def rates(tau, z):
        (x1, x2, y1, y2), (v1, v2, u1, u2) = z[:4], z[4:]
        between = e * system.alpha12_hat * (x2 - x1) + e * system.gamma12_hat * (v2 - v1)
        push = [0.0, 0.0]
        if tuning:
            for i, (x, v, y, u) in enumerate([(x1, v1, y1, u1), (x2, v2, y2, u2)]):
                w, zeta = tuning.frequency[i], tuning.damping[i]
                push[i] = e * (w**2 * (y - x) + 2 * zeta * w * (u - v))
        drive = e * np.sin((1 + e * system.sigma_e_hat) * tau)
        a1 = system.f10_hat * drive - x1 - e * system.gamma1_hat * v1 + between + push[0]
        ground2 = (1 + e * system.sigma20_hat) * x2 + e * system.gamma2_hat * v2
        a2 = system.f20_hat * drive - ground2 - between + push[1]
        return [v1, v2, u1, u2, a1, a2, -push[0] / e, -push[1] / e]

    return rates


@pytest.mark.parametrize(
    ("linear", "rates"),
    [
        (without_balls(DAMPED), by_hand(DAMPED)),
        (tuned(DAMPED, TUNING), by_hand(DAMPED, TUNING)),
    ],
    ids=["without balls", "tuned"],
)
def test_steady_amplitudes_are_those_of_integration(linear, rates):
    settle, times = 30 * DAMPED.period, np.linspace(0, DAMPED.period, 401)
    run = solve_ivp(
        rates, (0, settle + times[-1]), np.zeros(8), method="DOP853", rtol=1e-9, atol=1e-11, t_eval=settle + times
    )
    moved, amplitudes = np.abs(run.y[:2]).max(axis=1), linear.amplitudes(DAMPED.Omega)
    np.testing.assert_allclose(moved, amplitudes, rtol=2e-4)
    if len(linear.force) == 4:
        strokes = np.abs(run.y[:2] - run.y[2:4]).max(axis=1)
        np.testing.assert_allclose(strokes, np.ravel(linear.strokes(np.array([DAMPED.Omega]))), rtol=2e-4)
    np.testing.assert_allclose(np.sqrt((run.y[:2, :-1] ** 2).mean(axis=1)), amplitudes / math.sqrt(2), rtol=1e-5)


def test_the_textbook_tuning_has_the_known_amplitude_at_both_fixed_points():
    """At P and Q it is sqrt(1 + 2 / mu) times the static deflection for any damping (Den Hartog 1956)."""
    system = hosts()
    mu, frequency = system.epsilon, textbook_tuning(system).frequency
    for sign in (1, -1):
        Omega = math.sqrt((1 + sign * math.sqrt(mu / (2 + mu))) / (1 + mu))
        for damping in (0.01, 0.2, 0.9):
            amplitudes = tuned(system, Tuning(frequency, (damping, damping))).amplitudes(Omega)
            np.testing.assert_allclose(amplitudes / system.forcing, math.sqrt(1 + 2 / mu), rtol=1e-12)


def test_the_best_tuning_has_the_lowest_possible_peak_of_a_single_undamped_box():
    """The lowest peak has a closed form (Nishihara and Asami 2002)."""
    system, band = hosts(), (0.6, 1.5)
    mu = system.epsilon
    least = (8 + 9 * mu) ** 2 * (16 + 9 * mu) - 128 * (4 + 3 * mu) ** 1.5
    least = math.sqrt(least / (3 * (32 + 27 * mu))) / (3 * mu) * system.forcing[0]
    assert least < tuned(system, best_tuning(system, band)).peak(band) < least * (1 + 1e-4)


@pytest.mark.parametrize("ratio", [0.01, 0.1, 0.25])
def test_the_damping_of_the_textbook_tuning_is_the_printed_one(ratio):
    """The printed ratio is c / (2 m Omega_n), with the frequency Omega_n of the host.

    It is the root mean square of two dampings: with each of them, the response is level at one fixed point (Brock).
    """
    system = hosts(epsilon=ratio)
    tuning = textbook_tuning(system)
    damper = tuned(system, tuning).damping[2, 2]
    assert damper / (2 * ratio * 1.0) == pytest.approx(math.sqrt(3 * ratio / (8 * (1 + ratio) ** 3)), rel=1e-12)

    def slope(damping, at):
        ends = at + np.array([-1e-5, 1e-5])
        return np.diff(tuned(system, Tuning(tuning.frequency, (damping, damping))).amplitudes(ends)[:, 0]).item()

    places = [math.sqrt((1 + sign * math.sqrt(ratio / (2 + ratio))) / (1 + ratio)) for sign in (1, -1)]
    level = [brentq(slope, 0.01, 0.9, args=(place,)) for place in places]
    assert tuning.damping[0] == pytest.approx(math.sqrt(np.mean(np.square(level))), rel=1e-6)


def test_no_tuning_nearby_is_better_than_the_best():
    band = (0.7, 1.4)
    tuning = best_tuning(CHAPTER, band)
    lowest, rng = tuned(CHAPTER, tuning).peak(band), np.random.default_rng(5)
    assert lowest < tuned(CHAPTER, textbook_tuning(CHAPTER)).peak(band)
    for factors in np.exp(rng.normal(0.0, 1.0, (60, 4)) * rng.choice([0.003, 0.03, 0.3], (60, 1))):
        other = Tuning(tuple(tuning.frequency * factors[:2]), tuple(tuning.damping * factors[2:]))
        assert tuned(CHAPTER, other).peak(band) > lowest * (1 - 1e-4)


def test_a_peak_is_the_maximum_over_all_resonances():
    """A fine grid around each resonance finds no higher point, also if resonances are narrow."""
    for system in (CHAPTER, CHAPTER.with_(gamma1_hat=1e-4, gamma2_hat=2e-4, gamma12_hat=0.0)):
        linear = without_balls(system)
        poles = np.linalg.eigvals(linear.rate)[:, None]
        near = np.abs(poles.imag) + np.abs(poles.real) * np.linspace(-3, 3, 2001)
        assert linear.peak((0.7, 1.4)) == pytest.approx(linear.amplitudes(near).max(), rel=1e-6)
    assert without_balls(hosts()).peak((0.7, 1.4)) == math.inf
