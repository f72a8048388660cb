"""No impact is missed: runs from difficult starts have the events of the arbitrary-precision reference."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.optimize import brentq, minimize_scalar

import vibroimpact as vi
from attacks import same_events
from vibroimpact.accuracy.reference.run import reference_run
from vibroimpact.system.state import RELEASE

CYCLES = 5


def decimals(low, high):
    """Return a strategy of numbers with four decimals, equal for float64 and exact rationals."""
    return st.integers(round(low * 10**4), round(high * 10**4)).map(lambda n: n / 10**4)


RANGES = dict(
    epsilon=(0.01, 1), kappa=(0.05, 0.95), alpha12_hat=(0, 3), gamma1_hat=(0.01, 1), gamma2_hat=(0.01, 1),
    gamma12_hat=(0, 2), sigma20_hat=(-0.5, 2), sigma_e_hat=(-0.5, 2), f10_hat=(-2, 2), f20_hat=(-2, 2),
)  # fmt: skip
systems = st.builds(vi.System, **{name: decimals(*ends) for name, ends in RANGES.items()})


def assert_same_motion(system, start):
    run, truth = vi.simulate(system, start, CYCLES), reference_run(system, start, CYCLES, 40, exact_floats=False)
    assert same_events(run.events, truth.events, late=1e-6)
    error = np.abs(run.final - truth.final).max()  # includes the rounding of decimals to floats
    assert error <= 10 * run.certificate.error or run.certificate.undecided


@settings(max_examples=60)
@given(
    system=systems,
    walls=st.tuples(st.sampled_from([1, -1]), st.sampled_from([1, -1])),
    clearance=st.tuples(*[st.sampled_from([1e-1, 1e-3, 1e-5, 1e-7])] * 2),
    boxes=st.tuples(*[decimals(-1, 1)] * 4),
    slip=st.tuples(*[st.sampled_from([0.0, 1e-4, -1e-4, 1e-2, -1e-2])] * 2),
)
def test_starts_next_to_a_wall_almost_at_rest(system, walls, clearance, boxes, slip):
    """Grazing, chatter, sticking and release happen at almost the same time."""
    x1, x2, v1, v2 = boxes
    y = [round(x - w * (1 - c), 12) for x, w, c in zip((x1, x2), walls, clearance, strict=True)]
    u = [round(v - s, 8) for v, s in zip((v1, v2), slip, strict=True)]
    assert_same_motion(system, [x1, y[0], x2, y[1], v1, u[0], v2, u[1]])


@settings(max_examples=60)
@given(
    system=systems,
    walls=st.tuples(st.sampled_from([1, -1]), st.sampled_from([1, -1, 0])),
    boxes=st.tuples(*[decimals(0, 3)] * 2, *[decimals(-1, 1)] * 2),
    forces=st.tuples(*[decimals(-20, 20)] * 2),
    frequency=decimals(1, 6),
)
def test_balls_at_rest_on_walls_under_strong_forces(system, walls, boxes, forces, frequency):
    """The contact force rises and falls several times before it vanishes; ball 2 may fly instead."""
    sigma = round((frequency - 1.0) / system.epsilon, 4)
    system = system.with_(f10_hat=forces[0], f20_hat=forces[1], sigma_e_hat=sigma)
    x1, x2 = (-w * x if w else x for w, x in zip(walls, boxes, strict=False))  # the springs push the balls on
    v1, v2 = boxes[2:]
    assert_same_motion(system, [x1, round(x1 - walls[0], 4), x2, round(x2 - walls[1], 4), v1, v1, v2, v2])


FREE = dict(alpha12_hat=0.0, gamma1_hat=0.0, gamma2_hat=0.0, gamma12_hat=0.0, sigma20_hat=0.0)


@pytest.mark.parametrize("side", [1, -1], ids=["clears", "pierces"])
@pytest.mark.parametrize("module", [1, 2])
def test_hits_and_misses_are_distinguished_down_to_rounding(chapter, side, module):
    """An undamped unforced box swings to 1/2; its ball rests at -1/2 + delta, and the box misses it by delta."""
    system = chapter(0.0, 0.0, **FREE, sigma_e_hat=-6.0)  # period 2 pi / 0.4; the box turns at pi / 2, and out of reach

    def run(delta):
        start = np.zeros(8)
        start[2 * module - 1], start[2 * module + 2] = -0.5 + side * delta, 0.5
        return vi.simulate(system, start, 1)

    for delta in 10.0 ** -np.arange(2, 15):
        events, certificate = run(delta).events, run(delta).certificate
        assert len(events[events["tau"] < 3.0]) == (side < 0)
        # a miss is computed from the flight, a depth from the osculating parabola
        depth, accuracy = (certificate.nearest_miss, 1e-3) if side > 0 else (certificate.shallowest_hit, 2e-2)
        assert depth == pytest.approx(delta, rel=accuracy, abs=3e-16)
        assert certificate.undecided == 0
        assert certificate.decided or delta < 3e-14  # the smallest delta is the error of a position
    for delta in (0.0, 1e-16, 4e-16):
        assert run(delta).certificate.undecided >= 1
        assert not run(delta).certificate.decided


@pytest.mark.parametrize("side", [1, -1], ids=["holds", "releases"])
def test_a_ball_is_released_exactly_if_the_minimum_of_the_contact_force_is_negative(chapter, side):
    """The contact force in an undamped module under fast forcing has a minimum in closed form, which the start sets."""
    system, clearances = chapter(30.0, 0.0, **FREE, sigma_e_hat=50.0), []
    nu, omega = 1.0 / np.sqrt(1.0 + system.epsilon), system.Omega
    amplitude = system.forcing[0] / (1.0 - (omega / nu) ** 2)

    def force(t, x):
        return -(nu**2) * x * np.cos(nu * t) + amplitude * omega * (nu * np.sin(nu * t) - omega * np.sin(omega * t))

    def dip(x):
        return minimize_scalar(force, args=(x,), bounds=(0.5, 1.0), method="bounded", options={"xatol": 1e-9})

    for least in 10.0 ** -np.arange(1, 13):
        x = brentq(lambda x, least=least: dip(x).fun - side * least, -20.0, -0.1, xtol=1e-15)
        run = vi.simulate(system, [x, x - 1.0, 0, 0, 0, 0, 0, 0], 1)
        release = run.events[run.events["kind"] == RELEASE]["tau"]
        if side > 0:
            assert not len(release) or release[0] > 1.0
            clearances.append(run.certificate.clearance)
        else:
            expected = brentq(force, 0.3, dip(x).x, args=(x,), xtol=1e-15)
            assert release[0] == pytest.approx(expected, abs=1e-14 / np.sqrt(least))
    assert np.diff(np.log10(clearances[2:9])) == pytest.approx(-1, abs=0.05)  # proportional to the smallest force
