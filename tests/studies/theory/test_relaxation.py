"""The relaxation closure is the slow flow on the manifold, and linear where a ball has no impacts."""

import numpy as np
from scipy.linalg import expm

import vibroimpact as vi
from chapter import PARAMETERS
from vibroimpact.studies.theory.asymmetric_points import fixed_points
from vibroimpact.studies.theory.relaxation import describing_function, lost_at, relax
from vibroimpact.theory.manifold import B_min, B_of_C, C_min, rho
from vibroimpact.theory.slow_flow import FIRST_HARMONIC, impedances

EQUAL = vi.System(**PARAMETERS, f10_hat=1.0, f20_hat=1.0)
R = rho(EQUAL.kappa)


def test_describing_function_is_that_of_the_manifold():
    ball = describing_function(EQUAL.kappa)
    C = np.linspace(1.0, 1.68, 30)
    np.testing.assert_allclose(ball(B_of_C(C, R)), FIRST_HARMONIC * C / (1 - (1 + 1j * R) * C), rtol=1e-3)
    for point in fixed_points(EQUAL.with_(f20_hat=1.4)):
        if point.real:
            skewed = point.asymmetric
            from_power = FIRST_HARMONIC * R * (point.C / (1 - point.squared)) ** 2 / point.B**2
            np.testing.assert_allclose(ball(point.B).imag[skewed], from_power[skewed], rtol=1e-4)


def test_the_motion_with_balls_at_rest_is_linear():
    """The forces are too weak for impacts. The reference is the exponential of the linear flow from the same start."""
    system = EQUAL.with_(f10_hat=0.15, f20_hat=0.1)
    e, K = impedances(system)
    force, rate = np.array([0.15, 0.1]), (np.diag(e + K) - K * np.eye(2)[::-1]) / -2j
    steady = -np.linalg.solve(rate, force / 2j)
    tau = np.arange(1, 40 * 24 + 1) * system.epsilon * system.period / 24
    b = steady + np.array([expm(rate * t) @ (1e-4 - steady) for t in tau])
    found = relax(system, 40, 0, start=(1e-4, 1e-4))
    assert B_min(R) < np.abs(b).max() < 1
    np.testing.assert_allclose(found.largest, np.abs(b).max(axis=0), rtol=1e-5)
    assert found.share.max() < 0.01


def test_both_balls_stay_in_resonance_at_a_stable_point():
    system = EQUAL.with_(f20_hat=1.4)
    (point,) = [p for p in fixed_points(system) if p.real and p.slow_verdict() == "stable"]
    b = point.B * np.exp(-1j * point.psi)
    found = relax(system, 30, 0, start=b)
    assert found.share.tolist() == [1, 1]
    np.testing.assert_allclose(found.largest, point.B, rtol=1e-3)


def test_without_forces_balls_leave_resonance_when_amplitudes_reach_the_fold():
    """For a single module, d B^2 / d tau_1 = -mu rho C^2 - gamma B^2 is integrated along the arm to the fold."""
    system = EQUAL.with_(f10_hat=0.0, f20_hat=0.0, alpha12_hat=0.0, gamma12_hat=0.0)
    C = np.linspace(C_min(R), 1.6, 200001)
    B = B_of_C(C, R)
    rate = FIRST_HARMONIC * R * C**2 + system.gamma1_hat * B**2
    time = np.sum(np.diff(B**2) / (rate[1:] + rate[:-1]) * 2) / (system.epsilon * system.period)
    cycles = int(np.ceil(2 * time))
    found = relax(system, cycles, 0, start=(B[-1], B[-1]))
    np.testing.assert_allclose(found.share * cycles, time, atol=0.2)
    assert B_min(R) < B[-1] < 1


def test_the_pair_of_fig_10_8_loses_its_stability_where_a_module_passes_the_fold():
    (pair,) = [point for point in fixed_points(EQUAL) if abs(point.squared).max() < 0.01]
    factor = lost_at(EQUAL, pair)
    assert 0.92 < factor < 0.93
    above, below = (
        next(p for p in fixed_points(EQUAL.with_(f10_hat=f, f20_hat=f)) if 0 < p.squared[1] < 0.05)
        for f in (factor + 1e-3, factor - 1e-3)
    )
    assert above.C[0] > C_min(R) > below.C[0]
    assert (above.slow_verdict(), above.fast_verdict(EQUAL.kappa)) == ("stable", "stable")
    assert (below.slow_verdict(), below.fast_verdict(EQUAL.kappa)) == ("unstable", "unstable")
