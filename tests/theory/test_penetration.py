"""For which C the leading-order ball stays between the walls: against the motion (10.10) itself, sampled and exact."""

import mpmath
import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from scipy.optimize import minimize_scalar

from vibroimpact.theory import manifold as penetration

kappas = st.floats(0.001, 0.999)


def rho(kappa):
    return 2 * (1 - kappa) / (np.pi * (1 + kappa))


def W(t, C, kappa):
    """(10.10) with (10.11), (10.17), the time t after the impact with W = +1."""
    return (1 - C) * np.cos(t) + rho(kappa) * C * np.sin(t) + C * (1 - 2 * t / np.pi)


def excursion(C, kappa):
    """Largest |W| - 1 over a flight: sampled, then refined."""
    t = np.linspace(0, np.pi, 4001)
    k = np.abs(W(t, C, kappa)).argmax()
    around = t[max(k - 1, 0)], t[min(k + 1, len(t) - 1)]
    best = minimize_scalar(lambda s: -abs(W(s, C, kappa)), bounds=around, method="bounded", options={"xatol": 1e-10})
    return max(-best.fun, np.abs(W(t, C, kappa)).max()) - 1


@settings(max_examples=200)
@given(kappas, st.floats(-1, 12))
def test_within_the_walls_exactly_up_to_the_largest_C(kappa, C):
    limit = penetration.largest_C(kappa)
    assume(min(abs(C), abs(C - limit)) > 1e-3)
    beyond = excursion(C, kappa)
    assert penetration.stays_within_walls(C, kappa) == (beyond < 1e-9)


@given(kappas)
def test_at_the_largest_C_the_ball_grazes_the_wall_it_left(kappa):
    """W = 1 and W' = 0 there, in 50 digits from the double's value."""
    C, t = penetration.largest_C(kappa), penetration.grazing_time(kappa)
    with mpmath.workdps(50):
        k = mpmath.mpf(kappa)
        r = 2 * (1 - k) / (mpmath.pi * (1 + k))
        value = (1 - C) * mpmath.cos(t) + r * C * mpmath.sin(t) + C * (1 - 2 * t / mpmath.pi)
        rate = -(1 - C) * mpmath.sin(t) + r * C * mpmath.cos(t) - 2 * C / mpmath.pi
    assert 0 < t < 3 * np.pi / 4
    assert float(value) == pytest.approx(1, abs=1e-14)
    assert float(rate) == pytest.approx(0, abs=1e-13)


def test_limit_of_elastic_impacts_by_trigonometry():
    """rho = 0: W = 1 again where (1 + sin s) = C (sin s - 2 s / pi), s = t - pi/2; its least C by minimisation."""
    best = minimize_scalar(lambda s: (1 + np.sin(s)) / (np.sin(s) - 2 * s / np.pi), bounds=(0.1, 1.4), method="bounded")
    assert penetration.largest_C(1 - 1e-9) == pytest.approx(best.fun, rel=1e-8)


@pytest.mark.parametrize("kappa", [1e-300, 1e-12, 1e-6, 3e-5])
def test_limit_of_plastic_impacts(kappa):
    """tan(p) / p = 1 + kappa in 400 digits, p half the grazing time; C = 1 + (8 / pi) sqrt(kappa / 3) + ..."""
    with mpmath.workdps(400):
        p = mpmath.findroot(lambda p: mpmath.tan(p) - p * (1 + mpmath.mpf(kappa)), mpmath.sqrt(3 * mpmath.mpf(kappa)))
    assert penetration.grazing_time(kappa) == pytest.approx(float(2 * p), rel=1e-12)
    assert penetration.largest_C(kappa) == pytest.approx(1 + 8 * np.sqrt(kappa / 3) / np.pi, abs=3 * kappa + 1e-15)


@given(kappas, st.floats(-5, 5))
def test_impact_velocities_are_those_of_W(kappa, C):
    """Outward before and inward after an impact exactly for C > 0; Newton's rule."""
    before, after = penetration.impact_velocities(C, kappa)
    with mpmath.workdps(30):
        r = 2 * (1 - mpmath.mpf(kappa)) / (mpmath.pi * (1 + mpmath.mpf(kappa)))
        after_slope = r * C - 2 * C / mpmath.pi
        before_slope = r * C + 2 * C / mpmath.pi
    assert before == pytest.approx(float(before_slope), rel=1e-12, abs=1e-300)
    assert after == pytest.approx(float(after_slope), rel=1e-12, abs=1e-300)
    assert after == pytest.approx(-kappa * before, rel=1e-12, abs=1e-300)
