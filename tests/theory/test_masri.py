"""Masri's analysis: by computer algebra from the equations of motion, and against a ball flying between real walls."""

import itertools

import mpmath
import numpy as np
import pytest
import sympy
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.optimize import brentq

import vibroimpact as vi
from chapter import PARAMETERS
from vibroimpact.exact.orbits.search import orbits
from vibroimpact.theory import masri
from vibroimpact.theory.masri import limit_with_squares, printed_limit

kappas = st.floats(0.05, 0.95)
FOLD, BREAKING = 1 / (1 + (14 / (33 * np.pi)) ** 2), np.pi**2 / (np.pi**2 - 4)
"""Both limits at kappa = 0.65 by hand: rho = 2 (0.35) / (1.65 pi) = 14 / (33 pi)."""


# By computer algebra


@pytest.fixture(scope="module")
def derived():
    """Half-cycle map of (delta t, delta W'+), from free flight, wall and Newton's rule, in terms of C and kappa."""
    t1, t2, w1, w2, B = sympy.symbols("t1 t2 w1 w2 B", real=True)
    C, kappa = sympy.symbols("C kappa", positive=True)
    # Times are phases of U = B sin t; the ball is free, so W - U is straight from W(t1) = 1, W'(t1) = w1.
    slope = w1 - B * sympy.cos(t1)
    meets = 1 + B * (sympy.sin(t2) - sympy.sin(t1)) + slope * (t2 - t1) + 1
    # Seen in the mirror (W -> -W, half a cycle later) the motion after the impact with W = -1 is w2.
    newton = w2 - kappa * (B * sympy.cos(t2) + slope)
    equations = sympy.Matrix([meets, newton])
    ends, starts = sympy.Matrix([t2, w2]), sympy.Matrix([t1, w1])
    step = -equations.jacobian(ends).inv() * equations.jacobian(starts)
    # The periodic motion: (10.12) B sin t1 = 1 - C, (10.17) B cos t1 = rho C, slope of (10.11) -2 C / pi.
    a = sympy.Symbol("a", real=True)
    step = step.subs({t2: a + sympy.pi, t1: a}).subs(w1, -2 * C / sympy.pi + B * sympy.cos(a))
    rho = 2 * (1 - kappa) / (sympy.pi * (1 + kappa))
    step = sympy.expand_trig(step).subs({sympy.sin(a): (1 - C) / B, sympy.cos(a): rho * C / B})
    return sympy.simplify(step), C, kappa


def test_determinant_and_trace(derived):
    step, C, kappa = derived
    trace = 2 * kappa + sympy.pi**2 * (1 + kappa) ** 2 * (1 - C) / (4 * C)
    assert sympy.simplify(step.det() - kappa**2) == 0
    assert sympy.simplify(step.trace() - trace) == 0


def test_all_limits(derived):
    """A multiplier is +1 at the fold only, -1 at pi^2/(pi^2 - 4) only; a complex pair has modulus kappa."""
    step, C, kappa = derived
    rho = 2 * (1 - kappa) / (sympy.pi * (1 + kappa))
    plus, minus = (sympy.solve(sympy.numer(sympy.together(1 - s * step.trace() + step.det())), C) for s in (1, -1))
    assert [sympy.simplify(root - 1 / (1 + rho**2)) for root in plus] == [0]
    assert [sympy.simplify(root - sympy.pi**2 / (sympy.pi**2 - 4)) for root in minus] == [0]


@given(kappas, st.floats(0.05, 4))
def test_multipliers_are_the_squares_of_the_derived_eigenvalues(kappa, C):
    with mpmath.workdps(40):
        k, c = mpmath.mpf(kappa), mpmath.mpf(C)
        trace = 2 * k + mpmath.pi**2 * (1 + k) ** 2 * (1 - c) / (4 * c)
        roots = mpmath.polyroots([1, -trace, k**2], maxsteps=200, extraprec=200)
        total, product = complex(sum(z**2 for z in roots)), complex(roots[0] ** 2 * roots[1] ** 2)
    found = masri.multipliers(C, kappa)
    assert found.shape == (2,)
    assert found.sum() == pytest.approx(total, rel=1e-9, abs=1e-9)
    assert found.prod() == pytest.approx(product, rel=1e-9, abs=1e-13 * np.abs(found).max() ** 2)


def rho_of(kappa):
    return 2 * (1 - kappa) / (np.pi * (1 + kappa))


LIMITS = {"printed": lambda k: 4 / (4 + np.pi * rho_of(k)), "with squares": lambda k: (1 + k) ** 2 / (2 * (1 + k**2))}
"""(10.26) as printed, and as it would read if its squares had been lost: 4 / (4 + pi^2 rho^2)."""


def conditions(factors, kappa, C):
    """1 -+ trace + det of the half-cycle map with its nine terms times `factors`."""
    rho = rho_of(kappa)
    cos, sin, slope = rho * C, 1 - C, -2 * C / np.pi
    by_t2 = -factors[0] * cos + factors[1] * slope
    by_t1 = -factors[2] * cos - factors[3] * slope + factors[4] * np.pi * sin
    t = np.array([-by_t1, -factors[5] * np.pi]) / by_t2
    w = kappa * (factors[6] * sin * t + np.array([factors[7] * sin, factors[8]]))
    trace, det = t[0] + w[1], t[0] * w[1] - t[1] * w[0]
    return np.array([1 - trace + det, 1 + trace + det])


def limits_at(limit, factors):
    """Whether a multiplier +1, or -1, is met at a limit for three kappa, and not on both sides of it."""
    at, beside = ([np.abs(conditions(factors, k, share * limit(k))) for k in (0.3, 0.65, 0.8)] for share in (1, 0.9))
    return (np.max(at, axis=0) < 1e-6) & (np.max(beside, axis=0) > 1e-6)


def test_without_a_slip_the_limit_is_the_fold():
    assert conditions(np.ones(9), 0.65, FOLD)[0] == pytest.approx(0, abs=1e-12)
    assert limits_at(lambda k: 1 / (1 + rho_of(k) ** 2), np.ones(9)).tolist() == [True, False]


@pytest.mark.parametrize("reading", LIMITS)
def test_no_slip_in_one_or_two_terms_gives_the_printed_limit(reading):
    """Terms of the linearised conditions dropped, reversed, halved or doubled, one or two at a time."""
    for places in itertools.combinations(range(9), 2):
        for slips in itertools.product([1, 0, -1, 0.5, 2], repeat=2):
            factors = np.ones(9)
            factors[list(places)] = slips
            if (factors[:2] != 0).any():
                assert not limits_at(LIMITS[reading], factors).any()


# A ball between walls that oscillate as prescribed


def mirrored_impact(phase, speed, B, kappa):
    """Phase of U and slope of W - U after the next impact, mirrored so that a symmetric motion is a fixed point.

    The ball leaves W = 1 at the phase and flies straight in W - U until W = -1; then Newton's rule.
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


class Ball:
    """A free ball in a box that moves as B sin t: exact flights, the first wall found by scanning and root finding."""

    def __init__(self, C, kappa):
        r = 2 * (1 - kappa) / (np.pi * (1 + kappa))
        self.B, self.kappa = np.hypot(1 - C, r * C), kappa
        self.start = np.arctan2(1 - C, r * C), -2 * C / np.pi

    def next_impact(self, t, slope, wall):
        """Time, slope of W - U after it, and wall of the impact after the one at time t with `wall`."""
        offset = wall - self.B * np.sin(t)

        def W(s):
            return self.B * np.sin(t + s) + offset + slope * s

        grid = np.linspace(0, 12, 2401)[1:]
        values = W(grid)
        beyond = np.flatnonzero(np.abs(values) > 1)
        first = beyond[0]
        assert first > 0, "the ball does not leave its wall"
        hit = np.sign(values[first])
        s = brentq(lambda s: W(s) - hit, grid[first - 1], grid[first], xtol=1e-14)
        box = self.B * np.cos(t + s)
        return t + s, -self.kappa * (box + slope) - box, hit

    def distances(self, push, cycles):
        """Distance from the symmetric motion after each cycle, from a start pushed off it by (time, slope)."""
        t, slope, wall = self.start[0] + push[0], self.start[1] + push[1], 1.0
        found = []
        for n in range(1, cycles + 1):
            for _ in range(2):
                t, slope, wall = self.next_impact(t, slope, wall)
            assert wall == 1.0
            found.append(np.hypot(t - 2 * np.pi * n - self.start[0], slope - self.start[1]))
        return np.array(found)


@pytest.mark.parametrize("kappa", [0.3, 0.65, 0.9])
@pytest.mark.parametrize("share", [0.05, 0.5, 0.95])
def test_between_the_limits_the_ball_returns(kappa, share):
    low, high = masri.lower_limit(kappa), masri.upper_limit(kappa)
    C = low + share * (high - low)
    assert masri.stable(C, kappa) == "stable"
    cycles = int(np.ceil(np.log(1e-3) / np.log(np.abs(masri.multipliers(C, kappa)).max()))) + 20
    found = Ball(C, kappa).distances((1e-7, 1e-7), cycles)
    assert found[-1] < 2e-9


@pytest.mark.parametrize(
    ("kappa", "C"), [(0.65, 0.93), (0.65, 0.97), (0.3, 0.85), (0.65, 1.72), (0.9, 1.72), (0.3, 1.75)]
)
def test_outside_the_limits_the_ball_departs(kappa, C):
    """The first three motions satisfy (10.26): they are on its piece of the left arm. So do the others."""
    assert printed_limit(2 * (1 - kappa) / (np.pi * (1 + kappa))) < C
    assert masri.stable(C, kappa) == "unstable"
    found = Ball(C, kappa).distances((1e-9, 1e-9), 12)
    assert found[-1] > 3 * found[0]


# Limits and verdict


@given(kappas)
def test_both_readings_of_10_26_lie_below_the_fold(kappa):
    """4 / (4 + pi rho) is 2 (1 + kappa) / (3 + kappa)."""
    assert printed_limit(rho_of(kappa)) == pytest.approx(2 * (1 + kappa) / (3 + kappa), rel=1e-14)
    assert printed_limit(rho_of(kappa)) == pytest.approx(LIMITS["printed"](kappa), rel=1e-14)
    assert limit_with_squares(rho_of(kappa)) == pytest.approx(LIMITS["with squares"](kappa), rel=1e-13)
    for limit in LIMITS.values():
        assert limit(kappa) < masri.lower_limit(kappa)
        assert np.abs(masri.impact_multipliers(limit(kappa), kappa)).max() > 1


@given(kappas, st.floats(-2, 4), st.floats(0, 0.1))
def test_three_states(kappa, C, error):
    """Undecided exactly near a limit; elsewhere the multipliers say the same."""
    rho = 2 * (1 - kappa) / (np.pi * (1 + kappa))
    gap = min(abs(C - 1 / (1 + rho**2)), abs(C - BREAKING))
    if abs(gap - error) < 1e-12:
        return
    found = masri.stable(C, kappa, error)
    assert (found == "undecided") == (gap < error)
    if found != "undecided" and abs(C) > 1e-3:
        assert (found == "stable") == (np.abs(masri.multipliers(C, kappa)).max() < 1)


@pytest.mark.parametrize("limit", [FOLD, BREAKING])
def test_at_a_limit_rounding_leaves_it_undecided(limit):
    with pytest.raises(ValueError, match=r"^C: must not be 0"):
        masri.impact_multipliers(0.0, 0.65)
    assert masri.stable(limit, 0.65) == "undecided"
    assert masri.stable(limit + 1e-12, 0.65) != masri.stable(limit - 1e-12, 0.65)


# The exact system as epsilon tends to 0

FORCING = [(1.0, 1.0), (1.0, 0.89), (0.5, 0.5)]


@pytest.mark.parametrize("forcing", FORCING)
def test_fast_multipliers_of_exact_orbits_tend_to_masri_s(forcing):
    """Linearly in epsilon, for every fixed point of the chapter's cases."""
    f = dict(zip(("f10_hat", "f20_hat"), forcing, strict=True))
    for point in vi.fixed_points(vi.System(**PARAMETERS, **f)):
        expected = np.concatenate([masri.multipliers(C, 0.65) for C in point.C])
        gaps = []
        for epsilon in (2e-5, 1e-5):
            listed = [o for o in orbits(vi.System(**PARAMETERS | dict(epsilon=epsilon), **f)) if o.symmetric]
            orbit = min(listed, key=lambda o: np.abs(o.C - point.C).max())
            assert np.abs(orbit.C - point.C).max() < 10 * epsilon
            fast = np.array([orbit.multipliers[np.abs(orbit.multipliers - m).argmin()] for m in expected])
            gaps.append(np.abs(fast / expected - 1))
        assert np.all(gaps[1] < 5e-3)
        np.testing.assert_allclose(gaps[0] / gaps[1], 2, rtol=0.05)
