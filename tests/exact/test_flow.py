"""Free flight against a high-precision reference, and the exclusion bounds against what they promise."""

import math

import mpmath as mp
import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from vibroimpact.exact.exclusion import crossing_time, leaving_time, return_time, safe_time
from vibroimpact.exact.flow import CONTACT_STATES, advance, flow_of
from vibroimpact.system.matrices import rate_matrix

SPECTRA = {
    "chapter": {},
    "repeated": dict(alpha12_hat=0.0, gamma12_hat=0.0, sigma20_hat=0.0),
    "defective": dict(alpha12_hat=0.0, gamma12_hat=0.0, gamma1_hat=20.0, gamma2_hat=20.0, sigma20_hat=0.0),
    "undamped": dict(gamma1_hat=0.0, gamma2_hat=0.0, gamma12_hat=0.0),
    "stiff": dict(alpha12_hat=3000.0, gamma12_hat=50.0),
}


@pytest.mark.parametrize("changes", SPECTRA.values(), ids=SPECTRA)
def test_free_flight_against_50_digits(chapter, changes):
    system = chapter(1.0, 0.6, **changes)
    flow = flow_of(system)
    rng = np.random.default_rng(0)
    with mp.workdps(50):
        for mode, stuck in enumerate(CONTACT_STATES):
            rate = mp.matrix(rate_matrix(system, stuck).tolist())
            for t in (0.0, flow.spacing / 2, *rng.uniform(0, flow.longest, 3), flow.longest):
                z = [*rng.normal(size=4).tolist(), math.sin(0.7), math.cos(0.7)]
                exact = mp.expm(rate * mp.mpf(float(t))) * mp.matrix(z)
                error = max(abs(float(exact[i] - got)) for i, got in enumerate(advance(flow, mode, *z, float(t))))
                assert error < 2e-14 if changes is SPECTRA["stiff"] else error < 3e-15


numbers = st.floats(-2, 2).map(lambda x: round(x, 6))


@settings(max_examples=300, deadline=None)
@given(gap=st.floats(0, 2), v=numbers, a=numbers, j=numbers, horizon=st.floats(0.01, 3))
def test_safe_time_is_safe(gap, v, a, j, horizon):
    """On cubics with |g'''| <= bound, of both signs, the constraint holds up to the time returned, and it gets far."""
    assume(gap > 1e-6 or v < -1e-6)
    bound = abs(j)
    t = safe_time(gap, v, a, bound, horizon)
    assert 0 < t <= horizon
    s = np.linspace(0, t, 200)
    for third in (j, -j):
        assert (gap - v * s - a * s**2 / 2 - third * s**3 / 6).min() > -1e-14
    worst = np.poly1d([-bound / 6, -a / 2, -v, gap])
    zeros = [r.real for r in worst.roots if abs(r.imag) < 1e-9 and r.real > 1e-9]
    best = min([*zeros, horizon])
    assert t > 0.3 * best


@settings(max_examples=300, deadline=None)
@given(a=numbers.map(lambda x: -abs(x)), j=numbers, fourth=numbers)
def test_leaving_time_is_safe(a, j, fourth):
    if a == 0.0 and j >= 0.0:
        return
    t = leaving_time(a, j, abs(fourth), 3.0)
    s = np.linspace(0, t, 200)
    for sign in (1, -1):
        assert (-a * s**2 / 2 - j * s**3 / 6 - sign * fourth * s**4 / 24).min() > -1e-14
    assert t > 0


@settings(max_examples=300, deadline=None)
@given(zero=st.floats(1e-9, 0.5), v=st.floats(0.1, 2), a=numbers, j=numbers)
def test_crossing_time_finds_the_zero_of_a_cubic(zero, v, a, j):
    """A cubic built to vanish at a given time: where a crossing is claimed, it is the cubic's one zero around."""
    gap = v * zero + a * zero**2 / 2 + j * zero**3 / 6
    t = crossing_time(gap, v, (a, j, 0.0, 0.0), abs(j), 3.0)
    h = 2 * abs(gap) / v
    if t < math.inf:
        assert abs(t) <= h
        assert gap == pytest.approx(v * t + a * t**2 / 2 + j * t**3 / 6, abs=1e-12)
        assert not zero <= h or t == pytest.approx(zero, rel=1e-6)
    else:  # refused only where the slope could change much
        assert abs(a) * h + abs(j) * h**2 / 2 >= 0.5 * v or h > 3.0


@given(hop=st.floats(1e-12, 1e-3), a=st.floats(0.1, 2), j=numbers)
def test_return_time_keeps_relative_accuracy(hop, a, j):
    u = a * hop / 2 + j * hop**2 / 6
    assert return_time(u, (a, j, 0.0, 0.0), abs(j), 1.0) == pytest.approx(hop, rel=1e-14)
