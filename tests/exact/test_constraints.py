"""The exclusion of events rests on bounds of derivatives that hold along every flight, in every contact state."""

import math

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from vibroimpact.exact.constraints import push, remainder
from vibroimpact.exact.flow import CONTACT_STATES, flow_of, jet

unit = st.floats(-1, 1)


@settings(max_examples=100, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(
    state=st.tuples(*[unit] * 8), tau=st.floats(0, 6), horizon=st.floats(0.01, 2),
    forces=st.tuples(unit, unit), size=st.floats(0.01, 10), mode=st.integers(0, 3),
)  # fmt: skip
@pytest.mark.parametrize("damping", [0.0, 0.2])
def test_derivatives_stay_below_their_bounds(chapter, auditor, damping, state, tau, horizon, forces, size, mode):
    """Derivatives of matrix exponentials, sampled over the horizon."""
    system = chapter(
        10 * forces[0], 10 * forces[1], gamma1_hat=damping, gamma2_hat=damping, gamma12_hat=damping, sigma_e_hat=20.0
    )
    audit, q, state = auditor(system), flow_of(system).coefficients, size * np.array(state)
    rate = audit.rate(CONTACT_STATES[mode])
    walls = [int(stuck) for stuck in CONTACT_STATES[mode]]
    phase = system.Omega * tau
    sine, cosine = np.sin(phase), np.cos(phase)
    jets = jet(q, mode, tuple(state[[0, 2, 4, 6]]), sine, cosine)
    boxes = remainder(q, mode, jets, horizon * q.growth)
    _, force = push(q, mode, jets, 0, 1, sine, cosine, horizon)
    bounds = {7: math.factorial(7) * boxes, 9: math.factorial(7) * force}
    for t in np.linspace(0.0, horizon, 40):
        lifted = audit.lifted(audit.flow(state, walls, tau, t), tau + t)
        for order, bound in bounds.items():
            derivative = np.linalg.matrix_power(rate, order) @ lifted
            assert np.abs(derivative[:2]).max() <= bound * (1 + 1e-9) + 1e-9
