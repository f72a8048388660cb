"""Stability on the fast time scale: the linearised impact map against the impact map itself."""

import mpmath
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from vibroimpact.theory import manifold
from vibroimpact.theory.masri import SYMMETRY_BREAKING_C, impact_multipliers
from vibroimpact.theory.masri_printed import printed_limit


@given(st.floats(0.001, 0.999))
def test_printed_limit_is_on_the_lower_arm(kappa):
    """Below (10.26): the stable branch holds the upper arm and a piece of the lower arm."""
    r = manifold.rho(kappa)
    assert 0 < printed_limit(r) <= manifold.C_min(r)


@pytest.mark.parametrize(("kappa", "limit"), [(0.65, 3.3 / 3.65), (0.5, 3 / 3.5)])
def test_printed_limit_in_kappa(kappa, limit):
    """4 / (4 + pi rho) = 2 (1 + kappa) / (3 + kappa), by hand: 3.3/3.65 at 0.65, 3/3.5 at 0.5."""
    assert printed_limit(manifold.rho(kappa)) == pytest.approx(limit, rel=1e-14)


def next_impact(phase, speed, B, kappa):
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
        at = next_impact(phase, speed, B, k)
        assert max(abs(at[0] - phase), abs(at[1] - speed)) < mpmath.mpf(10) ** -30
        h = mpmath.mpf(10) ** -15
        columns = []
        for change in ((h, 0), (0, h)):
            ahead = next_impact(phase + change[0], speed + change[1], B, k)
            behind = next_impact(phase - change[0], speed - change[1], B, k)
            columns.append([(a - b) / (2 * h) for a, b in zip(ahead, behind, strict=True)])
        step = np.array(columns, dtype=float).T
    found = impact_multipliers(C, kappa)
    assert found.prod().real == pytest.approx(np.linalg.det(step), rel=1e-9)
    assert found.sum().real == pytest.approx(np.trace(step), rel=1e-9, abs=1e-9)


@given(st.floats(0.05, 0.95), st.floats(0.05, 4))
def test_stable_between_the_fold_and_symmetry_breaking(kappa, C):
    """Not for all C above (10.26): neither the piece of the lower arm nor the whole upper arm is stable."""
    fold = manifold.C_min(manifold.rho(kappa))
    if min(abs(C - fold), abs(C - SYMMETRY_BREAKING_C)) < 1e-9:
        return
    assert (np.abs(impact_multipliers(C, kappa)).max() < 1) == (fold < C < SYMMETRY_BREAKING_C)


def test_grazing_has_no_multipliers():
    with pytest.raises(ValueError, match=r"^C: 0\.0 is a grazing motion"):
        impact_multipliers(0.0, 0.65)
