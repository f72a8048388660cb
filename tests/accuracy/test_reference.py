"""The arbitrary-precision reference agrees with closed forms, matrix exponentials of mpmath and symmetries."""

from fractions import Fraction
from types import SimpleNamespace

import mpmath
import numpy as np
import pytest

pytest.importorskip("flint")

import one_box
from by_hand import BoxesByHand
from chapter import PARAMETERS
from vibroimpact.accuracy.reference.roots import Undecidable
from vibroimpact.accuracy.reference.run import departure, proven_run, reference_run
from vibroimpact.system.state import IMPACT, RELEASE, STICK

MODULATED = {name: str(value) for name, value in PARAMETERS.items()} | {"f10_hat": "0.5", "f20_hat": "0.5"}
OSCILLATOR = dict.fromkeys(MODULATED, "0") | {"epsilon": "0.1", "kappa": "0.65"}
"""Box 1 is a unit oscillator without damping and forcing; box 2 and its ball are at rest in most tests."""
TO_CHATTER = ["-1.9", "-2.88", "0", "0", "0", "-0.05", "0", "0"]


def mp(value):
    """Return a number of the reference as an mpf with all its digits."""
    return mpmath.mpf(value.str(200, radius=False)) if hasattr(value, "mid") else mpmath.mpf(value)


@pytest.mark.parametrize(
    ("changes", "walls"),
    [
        ({}, (0, 0)),
        ({"alpha12_hat": "0", "gamma12_hat": "0", "sigma20_hat": "0"}, (0, 0)),
        ({"alpha12_hat": "0", "gamma12_hat": "0", "gamma1_hat": "20"}, (0, 0)),  # box 1 is critically damped
        ({"gamma1_hat": "0", "gamma2_hat": "0", "gamma12_hat": "0"}, (0, 0)),
        ({"epsilon": "1", "alpha12_hat": "50", "gamma12_hat": "30"}, (0, 0)),
        *(({}, walls) for walls in ((1, 0), (0, -1), (1, -1))),
    ],
    ids=["chapter", "repeated", "defective", "undamped", "stiff", "ball 1 sticks", "ball 2 sticks", "both stick"],
)
def test_flights_are_those_of_the_matrix_exponential(changes, walls):
    """Balls fly, or stick to the wall that pushes them: +1 in box 1, -1 in box 2."""
    parameters = MODULATED | changes
    x, v = ("-1", "0.8"), ("0.05", "-0.1")
    y = [("-2", "1.8")[i] if walls[i] else ("-0.9", "0.5")[i] for i in range(2)]
    u = [v[i] if walls[i] else ("0.02", "-0.01")[i] for i in range(2)]
    state = [x[0], y[0], x[1], y[1], v[0], u[0], v[1], u[1]]
    run = reference_run(parameters, state, "0.1", 50, tau0=Fraction(7, 10), sample_times=[Fraction(11, 10)])
    assert len(run.events) == 0
    with mpmath.workdps(70):
        decimals = SimpleNamespace(**{name: mpmath.mpf(value) for name, value in parameters.items()})
        rate = mpmath.matrix(BoxesByHand(decimals).rate([wall != 0 for wall in walls]).tolist())
        phase = rate[4, 5] * 7 / 10
        start = mpmath.matrix([*map(mpmath.mpf, x + v), mpmath.sin(phase), mpmath.cos(phase)])

        def after(time):
            box, found = mpmath.expm(rate * time) * start, []
            for i, wall in enumerate(walls):
                flown = mpmath.mpf(y[i]) + mpmath.mpf(u[i]) * time
                found.append((box[i], box[i] - wall if wall else flown))
            for i, wall in enumerate(walls):
                found.append((box[2 + i], box[2 + i] if wall else mpmath.mpf(u[i])))
            return [value for pair in found for value in pair]

        expected = after(mpmath.pi / rate[4, 5] / 5)
        worst = max(abs(mp(value) - other) for value, other in zip(run.final_exact, expected, strict=True))
        assert worst < mpmath.mpf(10) ** -50
        np.testing.assert_allclose(run.samples[0], [float(v) for v in after(mpmath.mpf(4) / 10)], rtol=0, atol=2e-16)


@pytest.mark.parametrize("exponent", [2, 10, 20, 30])
def test_hits_and_misses_are_distinguished(exponent):
    """X1 = sin tau and a ball at rest at Y1 = delta, so that the maximum of W1 is 1 - delta."""
    delta = Fraction(1, 10**exponent)
    clears = reference_run(OSCILLATOR, [0, delta, 0, 0, 1, 0, 0, 0], "0.45", 80)
    hits = reference_run(OSCILLATOR, [0, -delta, 0, 0, 1, 0, 0, 0], "0.45", 80)
    assert len(clears.events) == 0
    assert tuple(hits.events[["module", "wall", "kind"]][0]) == (1, 1, IMPACT)
    with mpmath.workdps(100):
        expected = mpmath.asin(1 - mpmath.mpf(10) ** -exponent)
        assert abs(mp(hits.event_taus[0]) - expected) < mpmath.mpf(10) ** -80


def test_exact_grazing_is_undecidable():
    with pytest.raises(Undecidable, match="cannot decide whether a ball touches"):
        reference_run(OSCILLATOR, [0, 0, 0, 0, 1, 0, 0, 0], "0.45", 40)


def test_a_ball_at_rest_on_the_wall_is_released_and_impacts_at_the_times_of_the_closed_form():
    """The mass 1 + epsilon starts at rest at -1/2; the ball leaves wall +1 at X1 = 0, after which X1 = V sin t."""
    run = reference_run(OSCILLATOR, ["-0.5", "-1.5", 0, 0, 0, 0, 0, 0], "1.2", 50)
    assert [tuple(e) for e in run.events[["module", "wall", "kind"]]][:2] == [(1, 1, RELEASE), (1, -1, IMPACT)]
    with mpmath.workdps(70):
        frequency = 1 / mpmath.sqrt(mpmath.mpf(11) / 10)
        release, speed = mpmath.pi / 2 / frequency, frequency / 2
        flight = mpmath.findroot(lambda t: speed * (t - mpmath.sin(t)) - 2, 4.7)
        assert abs(mp(run.event_taus[0]) - release) < mpmath.mpf(10) ** -50
        assert abs(mp(run.event_taus[1]) - release - flight) < mpmath.mpf(10) ** -49
        assert abs(mp(run.event_states[0][4]) - speed) < mpmath.mpf(10) ** -50


def test_an_impact_in_the_other_module_releases_a_stuck_ball():
    parameters = OSCILLATOR | {"epsilon": "0.5", "gamma12_hat": "5"}
    run = reference_run(parameters, [0, "-0.9", "-0.2", "-1.2", 0, -2, 0, 0], "0.02", 40)
    assert [tuple(e) for e in run.events[["module", "wall", "kind"]]] == [(1, 1, IMPACT), (2, 1, RELEASE)]
    assert run.event_taus[0].overlaps(run.event_taus[1])
    x2, v1, v2 = run.events["state"][0][[2, 4, 6]]
    before = v1 + 0.5 * 1.65 / 1.5 * (-(run.events["state"][0][4] - run.events["state"][0][5]) / 0.65)
    assert -x2 + 2.5 * (before - v2) > 0 > -x2 + 2.5 * (v1 - v2)


def test_identical_modules_in_equal_states_move_like_a_single_module():
    """The coupling has no effect, and the events of both balls coincide, chatter included."""
    twins = OSCILLATOR | {"alpha12_hat": "3", "gamma12_hat": "1", "gamma1_hat": "0.4", "gamma2_hat": "0.4"}
    x, y, v, u = (TO_CHATTER[place] for place in (0, 1, 4, 5))
    both = reference_run(twins, [x, y, x, y, v, u, v, u], "0.9", 40)
    alone = reference_run(twins | {"alpha12_hat": "0", "gamma12_hat": "0"}, TO_CHATTER, "0.9", 40)
    assert set(alone.events["kind"]) == {IMPACT, STICK, RELEASE}
    for module in (1, 2):
        own = np.flatnonzero(both.events["module"] == module)
        assert np.array_equal(both.events["kind"][own], alone.events["kind"])
        differences = (both.event_taus[place] - tau for place, tau in zip(own, alone.event_taus, strict=True))
        assert max(float(abs(one).upper()) for one in differences) < 1e-36


def test_impacts_alone_dissipate_energy_without_damping_and_forcing():
    """An impact reduces the energy by (1 - kappa^2) epsilon / (1 + epsilon) W'^2 / 2; sticking conserves it.

    Impacts of a chatter slower than 1e-12 are not listed and have no effect within the tolerance.
    """
    start = ["-1.9", "-2.88", "1", "0.5", "0", "-0.05", "0.3", "0"]
    run = reference_run(OSCILLATOR | {"alpha12_hat": "2", "sigma20_hat": "1.5"}, start, 6, 40)

    def energy(state):
        x1, _, x2, _, v1, u1, v2, u2 = state
        kinetic = v1**2 + v2**2 + (u1**2 + u2**2) / 10
        return (kinetic + x1**2 + x2**2 * 115 / 100 + (x2 - x1) ** 2 / 5) / 2

    with mpmath.workdps(60):
        kappa, left = mpmath.mpf(65) / 100, energy([mpmath.mpf(value) for value in start])
        for event, exact_state in zip(run.events, run.event_states, strict=True):
            if event["kind"] == IMPACT:
                box, ball = (mp(value) for value in exact_state[2 + 2 * int(event["module"]) :][:2])
                left -= (1 - kappa**2) / 22 * ((box - ball) / kappa) ** 2
        assert set(run.events["kind"]) == {IMPACT, STICK, RELEASE}
        assert abs(left - energy([mp(value) for value in run.final_exact])) < 1e-23


def test_runs_with_more_digits_agree_in_the_modulated_case_with_chatter():
    start = ["0.1", "0.3", "0", "-0.2", "0", "0", "0.4", "0"]
    proven = proven_run(MODULATED, start, 160, digits=60)
    assert proven.agreement < 1e-18
    assert proven.run.digits == 2 * proven.coarse.digits
    assert proven.run.chatters == np.sum(proven.run.events["kind"] == STICK) > 0
    # The motion amplifies a perturbation far below the resolution of float64, so that the digits are necessary.
    nudged = [Fraction(start[0]) + Fraction(1, 10**20), *start[1:]]
    assert departure(reference_run(MODULATED, nudged, 160, 60), proven.run)[1].max() > 1e-10


def test_a_sample_at_the_start_is_the_state_after_an_impact_there():
    run = reference_run(OSCILLATOR, [0, -1, 0, 0, 1, 0, 0, 0], 0, 30, sample_times=[0])
    assert tuple(run.events[["module", "wall", "kind"]][0]) == (1, 1, IMPACT)
    np.testing.assert_allclose(run.samples[0][[4, 5]], [1 - 0.15, 1.5], rtol=1e-15)
    np.testing.assert_array_equal(run.samples[0], run.final)


def test_the_reference_uses_the_floats_of_a_system_or_their_decimals():
    """The floats give the closed form of an undamped box with the same floats, the decimals another motion."""
    system, start = one_box.one_box(0.1, 0.7, 0.3), [0.3, 0.1, 0.2, 0.9]
    state = [start[0], start[1], 0, 0, start[2], start[3], 0, 0]
    impacts, final = one_box.motion(system, start, 3)
    run, decimals = (reference_run(system, state, 3, 40, **more) for more in ({}, {"exact_floats": False}))
    assert len(run.events) == impacts > 3
    for place, value in zip((0, 1, 4, 5), final, strict=True):
        assert abs(run.final_exact[place] - value) < 1e-30
    assert max(abs(run.final_exact[place] - decimals.final_exact[place]) for place in (0, 1, 4, 5)) > 1e-18
