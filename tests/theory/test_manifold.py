"""The slow invariant manifold and its saw-tooth, (10.11)-(10.17), (10.25), satisfy impact conditions and walls."""

import mpmath
import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from scipy.optimize import minimize_scalar

from vibroimpact.theory import manifold

kappas = st.floats(0.001, 0.999)
amplitudes = st.floats(-4, 4)
angles = st.floats(-50, 50)


def rho(kappa):
    return 2 * (1 - kappa) / (np.pi * (1 + kappa))


@given(angles, amplitudes, angles)
def test_the_saw_tooth_is_the_arcsine_of_the_cosine(tau0, C, theta):
    with mpmath.workdps(40):
        exact = 2 / mpmath.pi * mpmath.asin(mpmath.cos(mpmath.mpf(tau0) - mpmath.mpf(theta))) * mpmath.mpf(C)
    assert manifold.sawtooth(tau0, C, theta) == pytest.approx(float(exact), abs=5e-14)


def test_fourier_coefficients_of_the_saw_tooth_are_those_of_10_19():
    samples, C, theta = 2**14, 0.7, 0.3
    spectrum = 2 * np.fft.rfft(manifold.sawtooth(2 * np.pi * np.arange(samples) / samples, C, theta)) / samples
    n = np.arange(1, 12)
    expected = np.where(n % 2, 8 / np.pi**2 * C / n**2, 0) * np.exp(-1j * n * theta)
    assert np.abs(spectrum[n] - expected).max() < 1e-7


@given(kappas, amplitudes)
def test_the_impact_is_at_the_wall_and_obeys_restitution(kappa, C):
    """(10.12), and (10.14) as Newton's rule: an impact multiplies the relative speed by -kappa."""
    r = manifold.rho(kappa)
    U = manifold.B_of_C(C, r) * np.exp(1j * manifold.impact_phase(C, r))
    assert U.imag + C == pytest.approx(1, abs=1e-14)
    before, after = U.real + 2 * C / np.pi, U.real - 2 * C / np.pi
    assert after == pytest.approx(-kappa * before, abs=1e-14)
    assert before == pytest.approx(4 * C / (np.pi * (1 + kappa)), abs=1e-14)  # outward exactly for C > 0


@given(kappas, amplitudes, st.floats(0, 10))
def test_10_15_and_10_16_are_the_same_curve_with_two_arms(kappa, C, above):
    r = manifold.rho(kappa)
    B = manifold.B_of_C(C, r)
    assert pytest.approx(1 - 2 * C + (1 + r**2) * C**2, abs=1e-13) == B**2
    lower, upper = manifold.C_of_B(max(B, manifold.B_min(r)), r)
    # B has a minimum at the fold, so that the error of C is the square root of rounding
    assert min(abs(lower - C), abs(upper - C)) < 1e-7
    assert lower <= manifold.C_min(r) + 1e-15 <= upper + 2e-15
    for arm in manifold.C_of_B(manifold.B_min(r) + above, r):
        assert manifold.B_of_C(arm, r) == pytest.approx(manifold.B_min(r) + above, rel=1e-12, abs=1e-14)


@given(kappas)
def test_the_fold_is_the_minimum(kappa):
    """(10.25); both arms end there."""
    r = manifold.rho(kappa)
    assert manifold.B_of_C(manifold.C_min(r), r) == pytest.approx(manifold.B_min(r), rel=1e-12)
    assert manifold.C_of_B(manifold.B_min(r), r) == pytest.approx((manifold.C_min(r),) * 2, rel=1e-14)
    assert manifold.B_of_C(manifold.C_min(r) + np.array([-1e-3, 1e-3]), r).min() > manifold.B_min(r)


def test_B_below_the_fold_is_refused():
    with pytest.raises(ValueError, match=r"^B: 0\.1 is below B_min = 0\.13"):
        manifold.C_of_B([0.5, 0.1], manifold.rho(0.65))


@given(kappas, amplitudes)
def test_slope_is_the_derivative(kappa, C):
    r = manifold.rho(kappa)
    with mpmath.workdps(40):
        exact = mpmath.diff(lambda c: mpmath.sqrt(1 - 2 * c + (1 + mpmath.mpf(r) ** 2) * c**2), mpmath.mpf(C))
    assert manifold.slope(C, r) == pytest.approx(float(exact), rel=1e-10, abs=1e-12)


def W(t, C, kappa):
    """Return W at the time t after the impact with W = +1, by (10.10) with (10.11) and (10.17)."""
    return (1 - C) * np.cos(t) + rho(kappa) * C * np.sin(t) + C * (1 - 2 * t / np.pi)


def excursion(C, kappa):
    """Return the largest |W| - 1 in a flight, refined from samples."""
    t = np.linspace(0, np.pi, 4001)
    k = np.abs(W(t, C, kappa)).argmax()
    around = t[max(k - 1, 0)], t[min(k + 1, len(t) - 1)]
    best = minimize_scalar(lambda s: -abs(W(s, C, kappa)), bounds=around, method="bounded", options={"xatol": 1e-10})
    return max(-best.fun, np.abs(W(t, C, kappa)).max()) - 1


@settings(max_examples=200)
@given(kappas, st.floats(-4, 12))
def test_the_ball_stays_within_the_walls_up_to_the_largest_C_and_beyond_exceeds_them_by_the_overshoot(kappa, C):
    beyond = excursion(C, kappa)
    assert float(manifold.overshoot(C, manifold.rho(kappa))) == pytest.approx(max(0.0, beyond), abs=1e-8)
    assume(min(abs(C), abs(C - manifold.largest_C(kappa))) > 1e-3)
    assert manifold.stays_within_walls(C, kappa) == (beyond < 1e-9)


@given(kappas)
def test_at_the_largest_C_the_ball_grazes_the_wall_it_left(kappa):
    """W = 1 and W' = 0 there, in 50 digits."""
    C, t = manifold.largest_C(kappa), manifold.grazing_time(kappa)
    with mpmath.workdps(50):
        k = mpmath.mpf(kappa)
        r = 2 * (1 - k) / (mpmath.pi * (1 + k))
        value = (1 - C) * mpmath.cos(t) + r * C * mpmath.sin(t) + C * (1 - 2 * t / mpmath.pi)
        rate = -(1 - C) * mpmath.sin(t) + r * C * mpmath.cos(t) - 2 * C / mpmath.pi
    assert 0 < t < 3 * np.pi / 4
    assert float(value) == pytest.approx(1, abs=1e-14)
    assert float(rate) == pytest.approx(0, abs=1e-13)


@pytest.mark.parametrize("kappa", [1e-300, 1e-12, 1e-6, 3e-5])
def test_limit_of_plastic_impacts(kappa):
    """Half the grazing time p solves tan(p) / p = 1 + kappa (400 digits); C = 1 + (8 / pi) sqrt(kappa / 3) + ..."""
    with mpmath.workdps(400):
        p = mpmath.findroot(lambda p: mpmath.tan(p) - p * (1 + mpmath.mpf(kappa)), mpmath.sqrt(3 * mpmath.mpf(kappa)))
    assert manifold.grazing_time(kappa) == pytest.approx(float(2 * p), rel=1e-12)
    assert manifold.largest_C(kappa) == pytest.approx(1 + 8 * np.sqrt(kappa / 3) / np.pi, abs=3 * kappa + 1e-15)
