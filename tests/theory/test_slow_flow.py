"""The linearisation of the slow flow against differences in high precision, and its behaviour at the fold."""

import mpmath
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import vibroimpact as vi
from chapter import PARAMETERS
from vibroimpact.theory import manifold
from vibroimpact.theory.slow_flow import jacobian, linearisation, rates, slow_eigenvalues

CHAPTER = vi.System(**PARAMETERS | dict(gamma2_hat=0.3, gamma12_hat=0.1), f10_hat=1.0, f20_hat=0.89)
C_values = st.floats(0.02, 4)
angles = st.floats(-3, 3)


def complex_rates(system, B, psi, C):
    """(10.22) in complex form, written out for mpmath: an independent route to the same right-hand sides."""
    mu = 8 / mpmath.pi**2
    r = 2 * (1 - mpmath.mpf(system.kappa)) / (mpmath.pi * (1 + mpmath.mpf(system.kappa)))
    K = mpmath.mpc(system.alpha12_hat, system.gamma12_hat)
    b = [B[i] * mpmath.expj(-psi[i]) for i in (0, 1)]
    dB, dpsi = [], []
    for i, j in ((0, 1), (1, 0)):
        own = mpmath.mpc(
            (0, system.sigma20_hat)[i] - 2 * mpmath.mpf(system.sigma_e_hat), (system.gamma1_hat, system.gamma2_hat)[i]
        )
        ball = mu * C[i] * (1 - C[i] + 1j * r * C[i]) / B[i] ** 2
        rate = ((system.f10_hat, system.f20_hat)[i] - (own + ball) * b[i] - K * (b[i] - b[j])) / 2j
        rate *= mpmath.expj(psi[i])
        dB.append(rate.real)
        dpsi.append(-rate.imag / B[i])
    return dB, dpsi


@given(st.tuples(C_values, C_values), st.tuples(angles, angles), st.tuples(st.floats(0.1, 3), st.floats(0.1, 3)))
def test_rates_agree_with_the_complex_form(C, psi, B):
    expected = np.array(complex_rates(CHAPTER, B, psi, C), dtype=float)
    assert np.array(rates(CHAPTER, np.array(B), np.array(psi), np.array(C))) == pytest.approx(expected, abs=1e-12)


@settings(max_examples=15)
@given(st.tuples(C_values, C_values), st.tuples(angles, angles))
def test_jacobian_against_high_precision_differences(C, psi):
    """At any point of the manifold, C following B on its arm."""
    r = mpmath.mpf(manifold.rho(CHAPTER.kappa))
    if min(abs(c - manifold.C_min(float(r))) for c in C) < 1e-3:
        return
    with mpmath.workdps(50):
        on_manifold = [mpmath.sqrt(1 - 2 * mpmath.mpf(c) + (1 + r**2) * mpmath.mpf(c) ** 2) for c in C]
        arm = [1 if c > 1 / (1 + r**2) else -1 for c in C]

        def flow(state):
            B, angle = state[0::2], state[1::2]
            along = [(1 + s * mpmath.sqrt((1 + r**2) * x**2 - r**2)) / (1 + r**2) for s, x in zip(arm, B, strict=True)]
            dB, dpsi = complex_rates(CHAPTER, B, angle, along)
            return [dB[0], dpsi[0], dB[1], dpsi[1]]

        base = [on_manifold[0], mpmath.mpf(psi[0]), on_manifold[1], mpmath.mpf(psi[1])]
        h = mpmath.mpf(10) ** -20
        columns = []
        for k in range(4):
            ahead, behind = list(base), list(base)
            ahead[k] += h
            behind[k] -= h
            columns.append([(a - b) / (2 * h) for a, b in zip(flow(ahead), flow(behind), strict=True)])
        expected = np.array(columns, dtype=float).T
    found = jacobian(CHAPTER, np.array(psi), np.array(C))
    assert found == pytest.approx(expected, rel=1e-9, abs=1e-9 * np.abs(expected).max())


def test_eigenvalues_are_those_of_the_jacobian():
    for point in vi.fixed_points(CHAPTER):
        expected = np.linalg.eigvals(jacobian(CHAPTER, point.psi, point.C))
        for value in point.slow_eigenvalues:
            assert np.abs(expected - value).min() < 1e-10
        assert np.all(np.diff(point.slow_eigenvalues.real) <= 0)


def kappa_with_exact_fold():
    """A kappa for which rounding leaves the slope of the manifold at C_min exactly 0."""
    for kappa in np.linspace(0.4, 0.8, 401):
        r = manifold.rho(kappa)
        if manifold.slope(manifold.C_min(r), r) == 0:
            return kappa, manifold.C_min(r)
    raise AssertionError("no such kappa")


def test_at_the_fold_one_eigenvalue_is_infinite():
    """C cannot follow B there: the slow flow jumps."""
    kappa, fold = kappa_with_exact_fold()
    system, psi, C = CHAPTER.with_(kappa=kappa), np.array([0.3, 0.4]), np.array([fold, 1.2])
    J, M = linearisation(system, psi, C)
    assert np.isfinite(J).all()
    assert np.diag(M)[[0, 1, 3]] == pytest.approx([0, 1, 1])
    assert np.count_nonzero(np.isfinite(slow_eigenvalues(system, psi, C))) == 3
    with pytest.raises(ValueError, match=r"^C: .* is at the fold C_min"):
        jacobian(system, psi, C)
