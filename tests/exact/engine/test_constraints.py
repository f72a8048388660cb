"""The proofs that no event happens use bounds of derivatives, which hold along every flight in every contact state."""

import math

import mpmath as mp
import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

import vibroimpact as vi
from by_hand import FlightsByHand
from vibroimpact.exact.engine.exclusion import LOOKAHEAD, gap, gap_rounding, own_remainder, push, remainder
from vibroimpact.exact.engine.flow import CONTACT_STATES, flow_of, jet
from vibroimpact.system.matrices import rate_matrix

unit = st.floats(-1, 1)


@settings(max_examples=100, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(
    state=st.tuples(*[unit] * 8), tau=st.floats(0, 6), horizon=st.floats(0.01, 2),
    forces=st.tuples(unit, unit), size=st.floats(0.01, 10), mode=st.integers(0, 3), tie=st.sampled_from([0, 1e-6, 1]),
)  # fmt: skip
@pytest.mark.parametrize("damping", [0.0, 0.2])
def test_derivatives_stay_below_their_bounds(chapter, damping, state, tau, horizon, forces, size, mode, tie):
    """The derivatives of matrix exponentials are sampled over the horizon."""
    system = chapter(
        10 * forces[0], 10 * forces[1], gamma1_hat=damping, gamma2_hat=damping, gamma12_hat=damping * tie,
        alpha12_hat=tie, sigma_e_hat=20.0,
    )  # fmt: skip
    flights, q, state = FlightsByHand(system), flow_of(system).coefficients, size * np.array(state)
    rate = flights.rate(CONTACT_STATES[mode])
    walls = [int(stuck) for stuck in CONTACT_STATES[mode]]
    phase = system.Omega * tau
    sine, cosine = np.sin(phase), np.cos(phase)
    jets = jet(q, mode, tuple(state[[0, 2, 4, 6]]), sine, cosine)
    both = remainder(q, mode, jets, horizon * q.growth)
    forces = np.abs(system.forcing) * system.Omega**6
    own = [own_remainder(q, mode, jets, both, i, forces[i], horizon) for i in range(2)]
    force = [push(q, mode, jets, i, 1, sine, cosine, horizon)[1] for i in range(2)]
    assert max(own) <= both
    bounds = {7: math.factorial(7) * np.array(own), 9: math.factorial(7) * np.array(force)}
    for t in np.linspace(0.0, horizon, 40):
        lifted = flights.lifted(flights.flow(state, walls, tau, t), tau + t)
        for order, bound in bounds.items():
            derivative = np.linalg.matrix_power(rate, order) @ lifted
            assert (np.abs(derivative[:2]) <= bound * (1 + 1e-9) + 1e-9).all()


@pytest.mark.parametrize("seed", range(12))
def test_a_gap_is_above_its_polynomial_minus_the_rounding_margin(seed):
    """The exact gap has 40 digits; systems are stiff and strongly forced, boxes move almost as one."""
    rng = np.random.default_rng(seed)

    def size(low, high):
        return float(10.0 ** rng.uniform(low, high))

    system = vi.System(
        epsilon=size(-3, 0), kappa=0.5, alpha12_hat=size(-2, 8), gamma1_hat=size(-2, 1), gamma2_hat=size(-2, 1),
        gamma12_hat=size(-2, 3), sigma20_hat=size(-2, 3), sigma_e_hat=size(-2, 3),
        f10_hat=size(-1, 5), f20_hat=-size(-1, 5),
    )  # fmt: skip
    flow, mode, phase = flow_of(system), seed % 4, rng.uniform(0, 6)
    q, boxes = flow.coefficients, rng.normal(size=4) * size(-1, 2)
    if seed % 3:
        boxes[1], boxes[3] = boxes[0] * (1 + size(-12, -1)), boxes[2]
    boxes, sine, cosine = tuple(boxes.tolist()), math.sin(phase), math.cos(phase)
    ball, speed = boxes[0] - rng.uniform(-1, 1), boxes[2] + rng.normal()
    jets, horizon = jet(q, mode, boxes, sine, cosine), LOOKAHEAD * flow.unit * size(-2.5, 0)
    polynomial = [*gap(jets[0], ball, speed, 1.0)[:7], -remainder(q, mode, jets, horizon * q.growth)]
    margin = gap_rounding(q, boxes, (ball, 0.0, speed, 0.0), 0)
    with mp.workdps(40):
        rate = mp.matrix(rate_matrix(system, CONTACT_STATES[mode]).tolist())
        for t in np.linspace(horizon / 6, horizon, 6):
            x = (mp.expm(rate * mp.mpf(t)) * mp.matrix([*boxes, sine, cosine]))[0]
            exact = 1 - (x - mp.mpf(ball) - mp.mpf(t) * mp.mpf(speed))
            assert mp.polyval([mp.mpf(c) for c in polynomial[::-1]], mp.mpf(t)) - margin / 4 <= exact
