"""The arbitrary-precision reference against closed forms, mpmath, SciPy and symmetries."""

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
# Box 1 alone, a unit oscillator without damping or forcing; box 2 at rest with its ball.
BUSY = ["0.1", "0.3", "0", "-0.2", "0", "0", "1.4", "0.1"]  # both balls impact from here
BARE = dict.fromkeys(MODULATED, "0") | {"epsilon": "0.1", "kappa": "0.65"}
TO_CHATTER = ["-1.9", "-2.88", "0", "0", "0", "-0.05", "0", "0"]


def mp(value):
    """A reference number as an mpf with all its digits."""
    return mpmath.mpf(value.str(200, radius=False)) if hasattr(value, "mid") else mpmath.mpf(value)


def rate_matrix(parameters, walls):
    """Rate matrix of [X1, X2, X1', X2', sin, cos] as an mpmath matrix, for balls that stick to walls or fly (0)."""
    decimal = SimpleNamespace(**{name: mpmath.mpf(value) for name, value in parameters.items()})
    return mpmath.matrix(BoxesByHand(decimal).rate([wall != 0 for wall in walls]).tolist())


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
def test_between_events_the_boxes_follow_the_matrix_exponential(changes, walls):
    """Balls fly, or stick to the wall that pushes them: +1 of box 1, -1 of box 2."""
    parameters = MODULATED | changes
    x, v = ("-1", "0.8"), ("0.05", "-0.1")
    y = [("-2", "1.8")[i] if walls[i] else ("-0.9", "0.5")[i] for i in range(2)]
    u = [v[i] if walls[i] else ("0.02", "-0.01")[i] for i in range(2)]
    state = [x[0], y[0], x[1], y[1], v[0], u[0], v[1], u[1]]
    run = reference_run(parameters, state, "0.1", 50, tau0=Fraction(7, 10), sample_times=[Fraction(11, 10)])
    assert len(run.events) == 0
    with mpmath.workdps(70):
        rate = rate_matrix(parameters, walls)
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

        wanted = after(mpmath.pi / rate[4, 5] / 5)
        worst = max(abs(mp(value) - other) for value, other in zip(run.final_exact, wanted, strict=True))
        assert worst < mpmath.mpf(10) ** -50
        np.testing.assert_allclose(run.samples[0], [float(v) for v in after(mpmath.mpf(4) / 10)], rtol=0, atol=2e-16)


@pytest.mark.parametrize("exponent", [2, 10, 20, 30])
def test_grazing_is_told_from_contact(exponent):
    """X1 = sin tau and a ball at rest at Y1 = delta: W1 peaks at 1 - delta."""
    delta = Fraction(1, 10**exponent)
    clears = reference_run(BARE, [0, delta, 0, 0, 1, 0, 0, 0], "0.45", 80)
    hits = reference_run(BARE, [0, -delta, 0, 0, 1, 0, 0, 0], "0.45", 80)
    assert len(clears.events) == 0
    assert tuple(hits.events[["module", "wall", "kind"]][0]) == (1, 1, IMPACT)
    with mpmath.workdps(100):
        expected = mpmath.asin(1 - mpmath.mpf(10) ** -exponent)
        assert abs(mp(hits.event_taus[0]) - expected) < mpmath.mpf(10) ** -80


def test_exact_grazing_is_undecidable():
    with pytest.raises(Undecidable, match="cannot decide whether a ball touches"):
        reference_run(BARE, [0, 0, 0, 0, 1, 0, 0, 0], "0.45", 40)


def test_release_from_rest_on_the_wall():
    """Ball stuck at wall +1: mass 1 + epsilon swings from -1/2 at rest, lets go at X1 = 0, then X1 = V sin t."""
    run = reference_run(BARE, ["-0.5", "-1.5", 0, 0, 0, 0, 0, 0], "1.2", 50)
    assert [tuple(e) for e in run.events[["module", "wall", "kind"]]][:2] == [(1, 1, RELEASE), (1, -1, IMPACT)]
    with mpmath.workdps(70):
        frequency = 1 / mpmath.sqrt(mpmath.mpf(11) / 10)
        release, speed = mpmath.pi / 2 / frequency, frequency / 2
        flight = mpmath.findroot(lambda t: speed * (t - mpmath.sin(t)) - 2, 4.7)
        assert abs(mp(run.event_taus[0]) - release) < mpmath.mpf(10) ** -50
        assert abs(mp(run.event_taus[1]) - release - flight) < mpmath.mpf(10) ** -49
        assert abs(mp(run.event_states[0][4]) - speed) < mpmath.mpf(10) ** -50


def test_stuck_ball_is_released_by_an_impact_in_the_other_module():
    parameters = BARE | {"epsilon": "0.5", "gamma12_hat": "5"}
    run = reference_run(parameters, [0, "-0.9", "-0.2", "-1.2", 0, -2, 0, 0], "0.02", 40)
    assert [tuple(e) for e in run.events[["module", "wall", "kind"]]] == [(1, 1, IMPACT), (2, 1, RELEASE)]
    assert run.event_taus[0].overlaps(run.event_taus[1])
    x2, v1, v2 = run.events["state"][0][[2, 4, 6]]
    before = v1 + 0.5 * 1.65 / 1.5 * (-(run.events["state"][0][4] - run.events["state"][0][5]) / 0.65)
    assert -x2 + 2.5 * (before - v2) > 0 > -x2 + 2.5 * (v1 - v2)


def test_coincident_chatter_of_identical_modules():
    """Equal modules in equal states move as one alone: the coupling never acts, both balls do everything together."""
    twins = BARE | {"alpha12_hat": "3", "gamma12_hat": "1", "gamma1_hat": "0.4", "gamma2_hat": "0.4"}
    x, y, v, u = (TO_CHATTER[place] for place in (0, 1, 4, 5))
    both = reference_run(twins, [x, y, x, y, v, u, v, u], "0.9", 40)
    alone = reference_run(twins | {"alpha12_hat": "0", "gamma12_hat": "0"}, TO_CHATTER, "0.9", 40)
    assert set(alone.events["kind"]) == {IMPACT, STICK, RELEASE}
    for module in (1, 2):
        own = np.flatnonzero(both.events["module"] == module)
        assert np.array_equal(both.events["kind"][own], alone.events["kind"])
        apart = (both.event_taus[place] - tau for place, tau in zip(own, alone.event_taus, strict=True))
        assert max(float(abs(one).upper()) for one in apart) < 1e-36


def test_energy_is_lost_in_impacts_only():
    """Without damping and forcing the energy falls by (1 - kappa^2) epsilon / (1 + epsilon) W'^2 / 2 per impact.

    Sticking conserves it, and impacts of a chatter slower than 1e-12 are too weak to count.
    """
    start = ["-1.9", "-2.88", "1", "0.5", "0", "-0.05", "0.3", "0"]
    run = reference_run(BARE | {"alpha12_hat": "2", "sigma20_hat": "1.5"}, start, 6, 40)

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


def test_doubled_digits_prove_the_modulated_case_through_chatter():
    start = ["0.1", "0.3", "0", "-0.2", "0", "0", "0.4", "0"]
    proven = proven_run(MODULATED, start, 160, digits=60)
    assert proven.agreement < 1e-18
    assert proven.run.digits == 2 * proven.coarse.digits
    assert proven.run.chatters == np.sum(proven.run.events["kind"] == STICK) > 0
    # A perturbation far below float64's resolution of the start is amplified, so digits are really needed.
    nudged = [Fraction(start[0]) + Fraction(1, 10**20), *start[1:]]
    apart = departure(reference_run(MODULATED, nudged, 160, 60), proven.run)[1]
    assert apart.max() > 1e-10


def test_impact_at_the_start_comes_before_a_sample_there():
    run = reference_run(BARE, [0, -1, 0, 0, 1, 0, 0, 0], 0, 30, sample_times=[0])
    assert tuple(run.events[["module", "wall", "kind"]][0]) == (1, 1, IMPACT)
    np.testing.assert_allclose(run.samples[0][[4, 5]], [1 - 0.15, 1.5], rtol=1e-15)
    np.testing.assert_array_equal(run.samples[0], run.final)


def test_mirror_symmetry():
    """Minus the state under minus the forcing, which is the forcing half a period later."""
    run = reference_run(MODULATED, BUSY, 6, 40)
    mirrored = [-Fraction(value) for value in BUSY]
    other = reference_run(MODULATED | {"f10_hat": "-0.5", "f20_hat": "-0.5"}, mirrored, 6, 40)
    assert np.array_equal(run.events["wall"], -other.events["wall"])
    assert max(float(abs(a + b).upper()) for a, b in zip(run.final_exact, other.final_exact, strict=True)) < 1e-38


def test_a_system_is_judged_with_its_floats_and_decimals_where_one_asks():
    """Of one undamped box in closed form, at the float Omega and start; decimals give another motion."""
    system, start = one_box.one_box(0.1, 0.7, 0.3), [0.3, 0.1, 0.2, 0.9]
    state = [start[0], start[1], 0, 0, start[2], start[3], 0, 0]
    impacts, final = one_box.motion(system, start, 3)
    run, decimals = (reference_run(system, state, 3, 40, **more) for more in ({}, {"exact_floats": False}))
    assert len(run.events) == impacts > 3
    for place, value in zip((0, 1, 4, 5), final, strict=True):
        assert abs(run.final_exact[place] - value) < 1e-30
    assert max(abs(run.final_exact[place] - decimals.final_exact[place]) for place in (0, 1, 4, 5)) > 1e-18
