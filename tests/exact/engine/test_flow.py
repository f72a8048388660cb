"""Free flights agree with 50 digits, and the bounds of polynomials in the proofs hold."""

import math

import mpmath as mp
import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st
from numba import njit

from by_hand import exact_rate
from vibroimpact.exact.engine.exclusion import crossing, least, nearby_zero, positive, return_time, safe_time
from vibroimpact.exact.engine.flow import CONTACT_STATES, advance, flow_of, jet, jet_at

SPECTRA = {
    "chapter": {},
    "repeated": dict(alpha12_hat=0.0, gamma12_hat=0.0, sigma20_hat=0.0),
    "defective": dict(alpha12_hat=0.0, gamma12_hat=0.0, gamma1_hat=20.0, gamma2_hat=20.0, sigma20_hat=0.0),
    "undamped": dict(gamma1_hat=0.0, gamma2_hat=0.0, gamma12_hat=0.0),
    "stiff": dict(alpha12_hat=3000.0, gamma12_hat=50.0),
}


@pytest.mark.parametrize("changes", SPECTRA.values(), ids=SPECTRA)
def test_free_flights_agree_with_50_digits(chapter, changes):
    system = chapter(1.0, 0.6, **changes)
    flow = flow_of(system)
    rng = np.random.default_rng(0)
    with mp.workdps(50):
        for mode, stuck in enumerate(CONTACT_STATES):
            rate = exact_rate(system, stuck)
            for t in (0.0, flow.spacing / 2, *rng.uniform(0, flow.longest, 3), flow.longest):
                z = [*rng.normal(size=4).tolist(), math.sin(0.7), math.cos(0.7)]
                exact = mp.expm(rate * mp.mpf(float(t))) * mp.matrix(z)
                boxes, sine, cosine = advance(flow, mode, tuple(z[:4]), z[4], z[5], float(t))
                error = max(abs(float(exact[i] - got)) for i, got in enumerate((*boxes, sine, cosine)))
                assert error < 2e-14 if changes is SPECTRA["stiff"] else error < 3e-15


numbers = st.floats(-2, 2).map(lambda x: round(x, 6))
polynomials = st.tuples(st.floats(1e-6, 2), *[numbers] * 7)


@pytest.mark.parametrize("changes", SPECTRA.values(), ids=SPECTRA)
def test_entries_of_the_flow_table_are_the_floats_nearest_to_the_exact_values(chapter, changes):
    """Positions, velocities and phases are compared at some of the times."""
    system = chapter(1.0, 0.6, **changes)
    flow = flow_of(system)
    with mp.workdps(60):
        for mode, stuck in enumerate(CONTACT_STATES):
            rate = exact_rate(system, stuck)
            for j in (0, 1, 2, 3, len(flow.rotations) // 3, len(flow.rotations) - 1):
                exact = np.array(mp.expm(rate * (j * mp.mpf(flow.spacing))).tolist()).astype(float)
                np.testing.assert_array_equal(flow.series[mode, j][:, [0, 8, 1, 9]], exact[:4].T)
                np.testing.assert_array_equal(flow.rotations[j], exact[4, 4:])


def test_taylor_series_at_the_start_and_in_the_table_agree_with_50_digits(chapter):
    system = chapter(1.0, 0.6)
    flow, z = flow_of(system), [0.3, -0.8, 0.5, 1.1, math.sin(0.7), math.cos(0.7)]
    with mp.workdps(50):
        for mode, stuck in enumerate(CONTACT_STATES):
            rate = exact_rate(system, stuck)
            for j in (None, 0, 1, len(flow.rotations) - 1):
                term = mp.expm(rate * ((j or 0) * flow.spacing)) * mp.matrix(z)
                one = jet(flow.coefficients, mode, tuple(z[:4]), *z[4:])
                jets = one if j is None else series_at(flow, mode, j, tuple(z))
                for k in range(8):
                    assert [jets[0][k], jets[1][k]] == pytest.approx([float(term[0]), float(term[1])], abs=2e-15)
                    term = rate * term / (k + 1)


@njit
def series_at(flow, mode, j, z):
    return jet_at(flow, mode, z[:4], z[4], z[5], j)


@given(c=polynomials, t=st.floats(0.01, 3))
@example(c=(1.0, -0.3, 0.01, 0.02, 0.01, 0.0, 0.0, 0.0), t=3.0)
@example(c=(1.0, -1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0), t=1.001)
def test_no_polynomial_with_a_zero_passes_the_quick_or_the_sharp_test_of_positivity(c, t):
    """The values of the polynomial are those of numpy on a grid."""
    lowest = np.polyval(c[::-1], np.linspace(0, t, 200)).min()
    rounding = 1e-12 * sum(abs(v) * t**k for k, v in enumerate(c))
    assert lowest > -rounding if positive(c, t) else least(c, t) <= 0.0


@settings(max_examples=300)
@given(c=polynomials, horizon=st.floats(0.01, 3))
@example(c=(0.25, -0.25, 1, 0, 0, 1, 0, -0.125), horizon=3)
def test_polynomials_are_positive_up_to_the_safe_time(c, horizon):
    """The safe time is at least half of the largest t for which the disc with diameter [0, t] contains no zero."""
    t = safe_time(c, horizon)
    assert 0 < t <= horizon
    assert np.polyval(c[::-1], np.linspace(0, t, 400)).min() > -1e-14
    free = [abs(z) ** 2 / z.real for z in np.roots(np.trim_zeros(c[::-1], "f")) if z.real > 0]
    assert t > 0.499 * min([*free, horizon])


@settings(max_examples=500)
@given(
    c=polynomials,
    fall=st.floats(0.05, 2),
    remainder=st.floats(0, 0.3).map(lambda x: round(x, 6)),
    part=st.sampled_from([-1.0, -0.3, 0.0, 0.6, 1.0]),
    horizon=st.floats(0.01, 3),
)
def test_a_certain_crossing_is_the_first_and_only_zero(c, fall, remainder, part, horizon):
    """This holds for each seventh derivative within its bound; the roots of the polynomials are those of numpy."""
    c = (c[0], -fall, *c[2:])
    certain, t, width = crossing(c, remainder, 0.0, horizon, 1e-3)
    if not certain:
        return
    roots = np.roots(np.trim_zeros((*c[:7], part * remainder)[::-1], "f"))
    zeros = sorted(r.real for r in roots if abs(r.imag) < 1e-9 and r.real > 0)
    if width == math.inf:
        assert t == horizon
        assert not [zero for zero in zeros if zero < horizon * (1 - 1e-9)]
    else:
        assert len([zero for zero in zeros if zero <= t + width + 1e-9]) == 1
        assert zeros[0] == pytest.approx(t, abs=width + 1e-9)


def test_a_crossing_is_certain_if_the_rate_keeps_its_sign_up_to_the_zero():
    """The rate may change its sign later, and the zero may be beyond the horizon."""
    certain, t, width = crossing((1.0, -1.0, -0.1, *[0.0] * 5), 1e-3, 1e-15, 2.0, 1e-3)
    assert certain
    assert 1e-4 < width < 5e-3
    assert abs(t - 5 * (math.sqrt(1.4) - 1)) < width
    assert crossing((1.0, -1.0, -0.1, *[0.0] * 5), 1e-3, 1e-15, 0.9, 1e-3) == (True, 0.9, math.inf)
    assert not crossing((1.0, -1.0, 0.26, *[0.0] * 5), 0.0, 1e-15, 3.0, 1e-3)[0]  # turns before it meets zero
    certain, t, _ = crossing((1e-4, -1.0, 0.5, *[0.0] * 5), 0.0, 1e-15, 3.0, 1e-3)  # turns long after
    assert certain
    assert t == pytest.approx(1 - math.sqrt(1 - 2e-4))


@given(zero=st.floats(-0.03, 0.03), off=st.floats(-0.005, 0.005), v=st.floats(0.1, 2), higher=st.tuples(*[numbers] * 6))
def test_nearby_zero_finds_the_zero_of_a_constructed_polynomial(zero, off, v, higher):
    rest = sum(a * zero ** (k + 2) for k, a in enumerate(higher))
    c = (v * zero - rest, -v, *higher)
    assert nearby_zero(c, zero + off) == pytest.approx(zero, abs=1e-15 + 1e-15 * abs(rest / v))


@given(hop=st.floats(1e-12, 0.02), a=st.floats(0.7, 2), j=numbers)
def test_return_time_keeps_relative_accuracy(hop, a, j):
    u = a * hop / 2 + j * hop**2 / 6
    assert return_time((0.0, u, -a / 2, -j / 6, *[0.0] * 4), 0.0, 1.0) == pytest.approx(hop, rel=1e-14)
