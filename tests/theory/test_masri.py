"""Masri's analysis agrees with computer algebra, the map of a ball between moving walls, and exact orbits."""

import mpmath
import numpy as np
import pytest
import sympy
from hypothesis import given, settings
from hypothesis import strategies as st

import vibroimpact as vi
from chapter import FORCES, system_of
from vibroimpact.exact.orbits.search import orbits
from vibroimpact.theory import masri
from vibroimpact.theory.masri import printed_limit

kappas = st.floats(0.05, 0.95)
FOLD, BREAKING = 1 / (1 + (14 / (33 * np.pi)) ** 2), np.pi**2 / (np.pi**2 - 4)
"""Both limits at kappa = 0.65, where rho = 2 (0.35) / (1.65 pi) = 14 / (33 pi)."""


def test_trace_determinant_and_limits_of_the_half_cycle_map_by_computer_algebra():
    """The map of (delta t, delta W'+) follows from free flight, wall and Newton's rule.

    A multiplier is +1 only at the fold, -1 only at pi^2/(pi^2 - 4); a complex pair has modulus kappa.
    """
    t1, t2, w1, w2, B = sympy.symbols("t1 t2 w1 w2 B", real=True)
    C, kappa = sympy.symbols("C kappa", positive=True)
    # Times are phases of U = B sin t; the ball is free, so that W - U is linear from W(t1) = 1, W'(t1) = w1.
    slope = w1 - B * sympy.cos(t1)
    wall = 1 + B * (sympy.sin(t2) - sympy.sin(t1)) + slope * (t2 - t1) + 1
    # w2 is minus the relative velocity after the impact with W = -1 (mirrored: W -> -W, half a cycle later).
    newton = w2 - kappa * (B * sympy.cos(t2) + slope)
    equations = sympy.Matrix([wall, newton])
    ends, starts = sympy.Matrix([t2, w2]), sympy.Matrix([t1, w1])
    step = -equations.jacobian(ends).inv() * equations.jacobian(starts)
    # The periodic motion: (10.12) B sin t1 = 1 - C, (10.17) B cos t1 = rho C, slope of (10.11) -2 C / pi.
    a = sympy.Symbol("a", real=True)
    step = step.subs({t2: a + sympy.pi, t1: a}).subs(w1, -2 * C / sympy.pi + B * sympy.cos(a))
    rho = 2 * (1 - kappa) / (sympy.pi * (1 + kappa))
    step = sympy.expand_trig(step).subs({sympy.sin(a): (1 - C) / B, sympy.cos(a): rho * C / B})
    step = sympy.simplify(step)
    trace = 2 * kappa + sympy.pi**2 * (1 + kappa) ** 2 * (1 - C) / (4 * C)
    assert sympy.simplify(step.det() - kappa**2) == 0
    assert sympy.simplify(step.trace() - trace) == 0
    plus, minus = (sympy.solve(sympy.numer(sympy.together(1 - s * trace + kappa**2)), C) for s in (1, -1))
    assert [sympy.simplify(root - 1 / (1 + rho**2)) for root in plus] == [0]
    assert [sympy.simplify(root - sympy.pi**2 / (sympy.pi**2 - 4)) for root in minus] == [0]


def mirrored_impact(phase, speed, B, kappa):
    """Return phase of U and slope of W - U after the next impact, mirrored so that symmetric motions are fixed points.

    The ball leaves W = 1 at the phase; W - U is linear until W = -1, where Newton's rule applies.
    """

    def miss(later):
        return 2 - B * (mpmath.sin(later) + mpmath.sin(phase)) + speed * (mpmath.pi + later - phase)

    later = mpmath.findroot(miss, phase)
    before = -B * mpmath.cos(later) + speed
    return later, -(-kappa * before + B * mpmath.cos(later))


@settings(max_examples=20)
@given(st.floats(0.05, 0.95), st.floats(0.1, 4))
def test_multipliers_are_those_of_the_impact_map(kappa, C):
    with mpmath.workdps(40):
        k, c = mpmath.mpf(kappa), mpmath.mpf(C)
        r = 2 * (1 - k) / (mpmath.pi * (1 + k))
        B = mpmath.sqrt((1 - c) ** 2 + (r * c) ** 2)
        phase, speed = mpmath.atan2(1 - c, r * c), -2 * c / mpmath.pi
        at = mirrored_impact(phase, speed, B, k)
        assert max(abs(at[0] - phase), abs(at[1] - speed)) < mpmath.mpf(10) ** -30
        h = mpmath.mpf(10) ** -15
        columns = []
        for change in ((h, 0), (0, h)):
            ahead = mirrored_impact(phase + change[0], speed + change[1], B, k)
            behind = mirrored_impact(phase - change[0], speed - change[1], B, k)
            columns.append([(a - b) / (2 * h) for a, b in zip(ahead, behind, strict=True)])
        step = np.array(columns, dtype=float).T
    found = masri.impact_multipliers(C, kappa)
    assert found.prod().real == pytest.approx(np.linalg.det(step), rel=1e-9)
    assert found.sum().real == pytest.approx(np.trace(step), rel=1e-9, abs=1e-9)
    assert masri.multipliers(C, kappa) == pytest.approx(found**2)


@given(kappas)
def test_the_limits_of_10_26_with_and_without_squares_are_below_the_fold(kappa):
    """The printed limit is 4 / (4 + pi rho); with squares it would be 4 / (4 + pi^2 rho^2)."""
    rho = 2 * (1 - kappa) / (np.pi * (1 + kappa))
    printed, squared = 2 * (1 + kappa) / (3 + kappa), (1 + kappa) ** 2 / (2 * (1 + kappa**2))
    assert printed_limit(rho) == pytest.approx(printed, rel=1e-14)
    for limit in (printed, squared):
        assert limit < masri.lower_limit(kappa)
        assert np.abs(masri.impact_multipliers(limit, kappa)).max() > 1


@given(kappas, st.floats(-2, 4), st.floats(0, 0.1))
def test_the_verdict_is_undecided_only_near_a_limit_and_otherwise_that_of_the_multipliers(kappa, C, error):
    rho = 2 * (1 - kappa) / (np.pi * (1 + kappa))
    gap = min(abs(C - 1 / (1 + rho**2)), abs(C - BREAKING))
    if abs(gap - error) < 1e-12:
        return
    found = masri.stable(C, kappa, error)
    assert (found == "undecided") == (gap < error)
    if found != "undecided" and abs(C) > 1e-3:
        assert (found == "stable") == (np.abs(masri.multipliers(C, kappa)).max() < 1)


@pytest.mark.parametrize("limit", [FOLD, BREAKING])
def test_the_verdict_at_a_limit_is_undecided(limit):
    assert masri.stable(limit, 0.65) == "undecided"
    assert masri.stable(limit + 1e-12, 0.65) != masri.stable(limit - 1e-12, 0.65)


def test_an_amplitude_of_zero_is_refused():
    with pytest.raises(ValueError, match=r"^C: must not be 0"):
        masri.impact_multipliers(0.0, 0.65)


@pytest.mark.parametrize("case", FORCES)
def test_fast_multipliers_of_exact_orbits_tend_to_those_of_masri(case):
    """The error is linear in epsilon, for each fixed point of the chapter's cases."""
    for point in vi.fixed_points(system_of(case)):
        expected = np.concatenate([masri.multipliers(C, 0.65) for C in point.C])
        gaps = []
        for epsilon in (2e-5, 1e-5):
            listed = [orbit for orbit in orbits(system_of(case, epsilon=epsilon)) if orbit.symmetric]
            orbit = min(listed, key=lambda o: np.abs(o.C - point.C).max())
            assert np.abs(orbit.C - point.C).max() < 10 * epsilon
            fast = np.array([orbit.multipliers[np.abs(orbit.multipliers - m).argmin()] for m in expected])
            gaps.append(np.abs(fast / expected - 1))
        assert np.all(gaps[1] < 5e-3)
        np.testing.assert_allclose(gaps[0] / gaps[1], 2, rtol=0.05)
