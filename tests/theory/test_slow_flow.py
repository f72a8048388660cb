"""The slow flow follows from (10.3) by computer algebra; its linearisation agrees with high-precision differences."""

import functools
from types import SimpleNamespace

import mpmath
import numpy as np
import pytest
import sympy as sp
from hypothesis import given, settings
from hypothesis import strategies as st

import vibroimpact as vi
from amplitude_rates import jacobian
from chapter import system_of
from vibroimpact.theory import manifold, slow_flow
from vibroimpact.theory.slow_flow import linearisation, slow_eigenvalues

eps, tau, t0, t1 = sp.symbols("epsilon tau tau_0 tau_1", real=True)
rho = sp.Symbol("rho", positive=True)
gamma = sp.symbols("gamma_1:3", nonnegative=True)
gamma12, alpha12 = sp.symbols("gamma_12 alpha_12", nonnegative=True)
sigma20, sigma_e = sp.symbols("sigma_20 sigma_e", real=True)
f = sp.symbols("f_1:3", real=True)
B = [sp.Function(f"B_{i}", positive=True)(t1) for i in (1, 2)]
phi = [sp.Function(f"phi_{i}", real=True)(t1) for i in (1, 2)]
C = sp.symbols("C_1:3", real=True)
theta = sp.symbols("theta_1:3", real=True)


def equations_10_3(U, W, D, forcing, hats):
    """Return the residuals (U equation, W equation) of (10.3) for each module, with misprints corrected, no impulses.

    D differentiates with respect to tau; `hats` converts a hatted parameter into the physical one.
    """
    X = [(U[i] + eps * W[i]) / (1 + eps) for i in (0, 1)]
    stiffness = (1, 1 + hats(sigma20))
    residuals = []
    for i, j in ((0, 1), (1, 0)):
        linear = hats(gamma[i]) * D(X[i]) + stiffness[i] * X[i] - forcing[i]
        linear += hats(gamma12) * (D(X[i]) - D(X[j])) + hats(alpha12) * (X[i] - X[j])
        residuals.append((D(D(U[i])) + linear, D(D(W[i])) + linear))
    return residuals


def test_10_3_follows_from_10_2():
    """With U = X + eps Y and W = X - Y, and the contact force eps P / (1 + eps) on the ball."""
    X, Y, P = ([sp.Function(f"{name}_{i}")(tau) for i in (1, 2)] for name in "XYP")
    force = [sp.Function(f"F_{i}")(tau) for i in (1, 2)]
    accelerations = {}
    for i, j in ((0, 1), (1, 0)):
        spring = (1, 1 + sigma20)[i] * X[i] + alpha12 * (X[i] - X[j])
        damper = gamma[i] * X[i].diff(tau) + gamma12 * (X[i] - X[j]).diff(tau)
        accelerations[X[i].diff(tau, 2)] = force[i] - spring - damper - eps * P[i] / (1 + eps)
        accelerations[Y[i].diff(tau, 2)] = P[i] / (1 + eps)
    U = [x + eps * y for x, y in zip(X, Y, strict=True)]
    W = [x - y for x, y in zip(X, Y, strict=True)]
    residuals = equations_10_3(U, W, lambda e: e.diff(tau), force, lambda hat: hat)
    for (of_U, of_W), impulse in zip(residuals, P, strict=True):
        assert sp.simplify(of_U.subs(accelerations)) == 0
        # Only the W equations contain the impulses: P / (1 + eps) * (1 + eps) = P.
        assert sp.simplify(of_W.subs(accelerations) + impulse) == 0


def multiple_scales(order):
    """Return the coefficients of eps^order in (10.3) under (10.4)-(10.7), and the leading-order parts."""

    def D(expression):
        return expression.diff(t0) + eps * expression.diff(t1)

    U0 = [B[i] * sp.sin(t0 + phi[i]) for i in (0, 1)]
    Z = [sp.Function(f"Z_{i}")(t0, t1) for i in (1, 2)]
    U1 = [sp.Function(f"U_{i}1")(t0, t1) for i in (1, 2)]
    W1 = [sp.Function(f"W_{i}1")(t0, t1) for i in (1, 2)]
    U = [U0[i] + eps * U1[i] for i in (0, 1)]
    W = [U0[i] + Z[i] + eps * W1[i] for i in (0, 1)]
    forcing = [eps * f[i] * sp.sin(t0 + sigma_e * t1) for i in (0, 1)]  # Omega tau = (1 + eps sigma_e) tau
    residuals = equations_10_3(U, W, D, forcing, lambda hat: eps * hat)
    take = [[sp.expand(sp.diff(r, eps, order).subs(eps, 0).doit()) for r in pair] for pair in residuals]
    return take, U0, U1, Z


def test_leading_order_is_10_8():
    residuals, U0, _, Z = multiple_scales(0)
    for i, (of_U, of_W) in enumerate(residuals):
        assert sp.simplify(of_U) == 0
        # W_i0'' + U_i0 with W_i0 = U_i0 + Z_i is the curvature of Z, that is, the impulses.
        assert sp.simplify(of_W - (U0[i].diff(t0, 2) + Z[i].diff(t0, 2) + U0[i])) == 0


@functools.cache
def solvability():
    """Return D_1 B_i and D_1 phi_i, (10.20), which follow since secular terms vanish at order eps."""
    residuals, _, U1, Z = multiple_scales(1)
    first_harmonic = {Z[i]: 8 / sp.pi**2 * C[i] * sp.cos(t0 - theta[i]) for i in (0, 1)}  # (10.19), n = 1
    conditions = []
    for i, (of_U, _) in enumerate(residuals):
        g = sp.expand(of_U - U1[i].diff(t0, 2) - U1[i])  # minus the right-hand side of (10.18)
        assert not g.has(*U1)
        g = sp.expand(sp.expand_trig(g.subs(first_harmonic).doit()))
        secular = sp.collect(g, [sp.sin(t0), sp.cos(t0)], evaluate=False)
        assert set(secular) == {sp.sin(t0), sp.cos(t0)}
        conditions += secular.values()
    unknown = [e.diff(t1) for pair in zip(B, phi, strict=True) for e in pair]
    return sp.solve(conditions, unknown, dict=True)[0], unknown


def test_slow_flow_is_the_solvability_condition(monkeypatch):
    """(10.22) follows from (10.20) by (10.17) and (10.21); the implementation is evaluated with symbols."""
    solution, unknown = solvability()
    b = np.array(sp.symbols("b_1:3", positive=True))
    psi = np.array(sp.symbols("psi_1:3", real=True))

    def autonomous(expression):
        for i in (0, 1):
            # theta_i = chi_i - phi_i with (10.17) for chi_i; phi_i = sigma_e tau_1 - psi_i, (10.21).
            chi = sp.Symbol(f"chi_{i}", real=True)
            expression = expression.subs(theta[i], chi - phi[i])
            expression = expression.subs(phi[i], sigma_e * t1 - psi[i]).subs(B[i], b[i])
            expression = sp.expand(sp.expand_trig(expression))
            expression = expression.subs({sp.sin(chi): (1 - C[i]) / b[i], sp.cos(chi): rho * C[i] / b[i]})
        return expression

    monkeypatch.setattr(slow_flow, "rho", lambda kappa: rho)
    monkeypatch.setattr(slow_flow, "FIRST_HARMONIC", 8 / sp.pi**2)
    symbols = SimpleNamespace(
        kappa=None, alpha12_hat=alpha12, gamma12_hat=gamma12, gamma1_hat=gamma[0], gamma2_hat=gamma[1],
        sigma20_hat=sigma20, sigma_e_hat=sigma_e, f10_hat=f[0], f20_hat=f[1],
    )  # fmt: skip
    cosine = np.array([sp.cos(angle) for angle in psi])
    sine = np.array([sp.sin(angle) for angle in psi])
    dB, dpsi = slow_flow.rates_from_phasors(symbols, b, cosine, sine, np.array(C))
    for i in (0, 1):
        derived_B = autonomous(solution[unknown[2 * i]])
        derived_psi = autonomous(sigma_e - solution[unknown[2 * i + 1]])
        assert sp.expand((derived_B - dB[i]).rewrite(sp.exp)) == 0
        assert sp.expand((derived_psi - dpsi[i]).rewrite(sp.exp)) == 0


def test_the_complex_form_of_the_slow_flow_holds_for_any_first_harmonic_of_the_saw_tooth():
    """2i D_1 b_i = f_i - (e_i + N_i) b_i - K (b_i - b_j), where N_i U_i is the first harmonic of Z_i."""
    solution, unknown = solvability()
    turn = [sp.exp(sp.I * (phi[i] - sigma_e * t1)) for i in (0, 1)]
    b = [B[i] * turn[i] for i in (0, 1)]
    for i, j in ((0, 1), (1, 0)):
        N = 8 / sp.pi**2 * C[i] * sp.I * sp.exp(-sp.I * (theta[i] + phi[i])) / B[i]
        e = (0, sigma20)[i] - 2 * sigma_e + sp.I * gamma[i]
        balance = f[i] - (e + N) * b[i] - (alpha12 + sp.I * gamma12) * (b[i] - b[j])
        D1_b = (solution[unknown[2 * i]] + sp.I * B[i] * (solution[unknown[2 * i + 1]] - sigma_e)) * turn[i]
        assert sp.simplify(sp.expand((2 * sp.I * D1_b - balance).rewrite(sp.exp))) == 0


SYSTEM = system_of("unequal", gamma2_hat=0.3, gamma12_hat=0.1)
C_values = st.floats(0.02, 4)
angles = st.floats(-3, 3)


@settings(max_examples=15)
@given(st.tuples(C_values, C_values), st.tuples(angles, angles))
def test_the_jacobian_agrees_with_high_precision_differences(C, psi):
    """The points are on the manifold, and C follows from B on an arm."""
    r = mpmath.mpf(manifold.rho(SYSTEM.kappa))
    if min(abs(c - manifold.C_min(float(r))) for c in C) < 1e-3:
        return
    with mpmath.workdps(50):
        on_manifold = [mpmath.sqrt(1 - 2 * mpmath.mpf(c) + (1 + r**2) * mpmath.mpf(c) ** 2) for c in C]
        arm = [1 if c > 1 / (1 + r**2) else -1 for c in C]

        def flow(state):
            B, angle = state[0::2], state[1::2]
            along = [(1 + s * mpmath.sqrt((1 + r**2) * x**2 - r**2)) / (1 + r**2) for s, x in zip(arm, B, strict=True)]
            cosine, sine = ([of(x) for x in angle] for of in (mpmath.cos, mpmath.sin))
            return np.ravel(slow_flow.rates_from_phasors(SYSTEM, *map(np.array, (B, cosine, sine, along))), order="F")

        base = np.array([on_manifold[0], mpmath.mpf(psi[0]), on_manifold[1], mpmath.mpf(psi[1])])
        steps = mpmath.mpf(10) ** -20 * np.eye(4, dtype=object)
        columns = [(flow(base + step) - flow(base - step)) / (2 * step.sum()) for step in steps]
        expected = np.array(columns, dtype=float).T
    found = jacobian(SYSTEM, np.array(psi), np.array(C))
    assert found == pytest.approx(expected, rel=1e-9, abs=1e-9 * np.abs(expected).max())


def test_eigenvalues_of_fixed_points_are_those_of_the_jacobian():
    for point in vi.fixed_points(SYSTEM):
        expected = np.linalg.eigvals(jacobian(SYSTEM, point.psi, point.C))
        for value in point.slow_eigenvalues:
            assert np.abs(expected - value).min() < 1e-10
        assert np.all(np.diff(point.slow_eigenvalues.real) <= 0)


def test_one_eigenvalue_is_infinite_at_the_fold():
    """The slow flow jumps there. For some kappa, the rounded slope of the manifold at C_min is exactly 0."""
    folds = {kappa: manifold.C_min(manifold.rho(kappa)) for kappa in np.linspace(0.4, 0.8, 401)}
    kappa = next(kappa for kappa, fold in folds.items() if manifold.slope(fold, manifold.rho(kappa)) == 0)
    system, psi, C = SYSTEM.with_(kappa=kappa), np.array([0.3, 0.4]), np.array([folds[kappa], 1.2])
    J, M = linearisation(system, psi, C)
    assert np.isfinite(J).all()
    assert np.diag(M)[[0, 1, 3]] == pytest.approx([0, 1, 1])
    assert np.count_nonzero(np.isfinite(slow_eigenvalues(system, psi, C))) == 3
