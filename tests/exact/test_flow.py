"""Free flight against a high-precision reference, and the exclusion bounds against what they promise."""

import math

import mpmath as mp
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from vibroimpact.exact.exclusion import crossing_time, return_time, safe_time
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
@given(start=st.floats(1e-6, 2), slopes=st.tuples(*[numbers] * 5), horizon=st.floats(0.01, 3))
def test_safe_time_is_safe_and_reaches_far(start, slopes, horizon):
    """On quintics: positive up to the time returned (numpy's roots), and near the first zero or the horizon."""
    c = (start, *slopes)
    t = safe_time(c, horizon)
    assert 0 < t <= horizon
    assert np.polyval(c[::-1], np.linspace(0, t, 400)).min() > -1e-14
    zeros = [r.real for r in np.roots(np.trim_zeros(c[::-1], "f")) if abs(r.imag) < 1e-9 and r.real > 0]
    assert t > 0.05 * min([*zeros, horizon])


def test_safe_time_without_a_positive_start():
    assert safe_time((0.0, 1.0, 0.0, 0.0, 0.0, 0.0), 1.0) == 0.0
    assert safe_time((-1e-20, 1.0, 0.0, 0.0, 0.0, 0.0), 1.0) == 0.0


def test_safe_times_converge_to_a_crossing_and_never_pass_it():
    """cos t = 1/2 approached as a flight does, fifth derivative bounded by 1."""
    t, times = 0.0, []
    while len(times) < 12:
        c, s = math.cos(t), math.sin(t)
        step = safe_time((c - 0.5, -s, -c / 2, s / 6, c / 24, -1 / 120), 2.0)
        t += step
        times.append(t)
    assert max(times) <= math.pi / 3 + 1e-15  # the rounding of the cosine
    assert math.pi / 3 - times[2] < 1e-6
    assert math.pi / 3 - times[-1] < 1e-8


@settings(max_examples=300, deadline=None)
@given(zero=st.floats(1e-9, 0.5), v=st.floats(0.1, 2), a=numbers, j=numbers)
def test_crossing_time_finds_the_zero_of_a_cubic(zero, v, a, j):
    """A cubic built to vanish at a given time: where a crossing is claimed, it is the cubic's one zero around."""
    gap = v * zero + a * zero**2 / 2 + j * zero**3 / 6
    t = crossing_time(gap, v, (a, j, 0.0), 0.0, 3.0)
    h = 2 * abs(gap) / v
    if t < math.inf:
        assert abs(t) <= h
        assert gap == pytest.approx(v * t + a * t**2 / 2 + j * t**3 / 6, abs=1e-12)
        assert not zero <= h or t == pytest.approx(zero, rel=1e-6)
    else:  # refused only where the slope could change much
        assert abs(a) * h + abs(j) * h**2 / 2 >= 0.499 * v or h > 2.99


@given(hop=st.floats(1e-12, 1e-3), a=st.floats(0.1, 2), j=numbers)
def test_return_time_keeps_relative_accuracy(hop, a, j):
    u = a * hop / 2 + j * hop**2 / 6
    assert return_time(u, (a, j, 0.0), 0.0, 1.0) == pytest.approx(hop, rel=1e-14)
