"""The slow invariant manifold against the impact conditions it comes from, (10.12)-(10.17) and (10.25)."""

import mpmath
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from vibroimpact.theory import manifold

kappas = st.floats(0.001, 0.999)
amplitudes = st.floats(-4, 4)


@given(kappas, amplitudes)
def test_the_ball_meets_the_wall_at_one(kappa, C):
    """(10.12)."""
    r = manifold.rho(kappa)
    assert manifold.B_of_C(C, r) * np.sin(manifold.impact_phase(C, r)) + C == pytest.approx(1, abs=1e-14)


@given(kappas, amplitudes)
def test_the_impact_obeys_restitution(kappa, C):
    """(10.14), as Newton's rule: relative speed -kappa times the one before."""
    r = manifold.rho(kappa)
    of_U = manifold.B_of_C(C, r) * np.cos(manifold.impact_phase(C, r))
    before, after = of_U + 2 * C / np.pi, of_U - 2 * C / np.pi
    assert after == pytest.approx(-kappa * before, abs=1e-14)


@given(kappas, amplitudes)
def test_10_15_and_10_16_are_the_same_curve(kappa, C):
    r = manifold.rho(kappa)
    B = manifold.B_of_C(C, r)
    assert pytest.approx(1 - 2 * C + (1 + r**2) * C**2, abs=1e-13) == B**2
    lower, upper = manifold.C_of_B(max(B, manifold.B_min(r)), r)
    # B is flat at the fold: C is known there to the square root of rounding only.
    assert min(abs(lower - C), abs(upper - C)) < 1e-7
    assert lower <= manifold.C_min(r) + 1e-15 <= upper + 2e-15


@given(kappas, st.floats(0, 10))
def test_both_arms_solve_10_16(kappa, above):
    r = manifold.rho(kappa)
    B = manifold.B_min(r) + above
    for C in manifold.C_of_B(B, r):
        assert manifold.B_of_C(C, r) == pytest.approx(B, rel=1e-12, abs=1e-14)


@given(kappas)
def test_the_fold_is_the_minimum(kappa):
    """(10.25), with both arms meeting there exactly."""
    r = manifold.rho(kappa)
    assert manifold.B_of_C(manifold.C_min(r), r) == pytest.approx(manifold.B_min(r), rel=1e-12)
    assert manifold.C_of_B(manifold.B_min(r), r) == pytest.approx((manifold.C_min(r),) * 2, rel=1e-14)
    assert manifold.B_of_C(manifold.C_min(r) + np.array([-1e-3, 1e-3]), r).min() > manifold.B_min(r)


def test_below_the_fold_there_is_no_manifold():
    with pytest.raises(ValueError, match=r"^B: 0\.1 is not at least B_min = 0\.13"):
        manifold.C_of_B([0.5, 0.1], manifold.rho(0.65))


@given(kappas, amplitudes)
def test_slope_is_the_derivative(kappa, C):
    r = manifold.rho(kappa)
    with mpmath.workdps(40):
        exact = mpmath.diff(lambda c: mpmath.sqrt(1 - 2 * c + (1 + mpmath.mpf(r) ** 2) * c**2), mpmath.mpf(C))
    assert manifold.slope(C, r) == pytest.approx(float(exact), rel=1e-10, abs=1e-12)


def sampled_overshoot(C, r):
    tau = np.linspace(0, np.pi, 20001)
    W = (1 - C) * np.cos(tau) + r * C * np.sin(tau) + C * (1 - 2 * tau / np.pi)
    return max(0.0, np.abs(W).max() - 1)


@given(kappas, st.floats(-4, 12))
def test_overshoot_is_the_largest_excursion_beyond_the_walls(kappa, C):
    r = manifold.rho(kappa)
    assert float(manifold.overshoot(C, r)) == pytest.approx(sampled_overshoot(C, r), abs=1e-6)
