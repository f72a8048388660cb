"""The leading-order response against the impact conditions and the definitions of U and W."""

import numpy as np
import pytest

import vibroimpact as vi
from chapter import PARAMETERS
from vibroimpact.theory.response import impact_times, leading_order

SYSTEM = vi.System(**PARAMETERS, f10_hat=1.0, f20_hat=1.0)
POINTS = vi.fixed_points(SYSTEM)
both = pytest.mark.parametrize("module", [0, 1])
each = pytest.mark.parametrize("point", POINTS, ids=range(len(POINTS)))


@each
def test_U_and_W_are_those_of_X_and_Y(point):
    response = leading_order(SYSTEM, point, np.linspace(-3, 40, 101))
    assert response.X + SYSTEM.epsilon * response.Y == pytest.approx(response.U, abs=1e-14)
    assert np.abs(response.X - response.Y - response.W).max() < 1e-14
    assert response.U.shape == (101, 2)


@each
@both
def test_impacts_at_the_walls_obey_restitution(point, module):
    for wall, shift in ((1, 0.0), (-1, SYSTEM.period / 2)):
        at = impact_times(SYSTEM, point)[module] + shift
        h = 1e-6 * SYSTEM.period
        W = leading_order(SYSTEM, point, at + h * np.array([-2, -1, 0, 1, 2])).W[:, module]
        assert W[2] == pytest.approx(wall, abs=1e-12)
        before, after = (W[1] - W[0]) / h, (W[4] - W[3]) / h
        assert after == pytest.approx(-SYSTEM.kappa * before, abs=2e-5)
        assert wall * before > 0


@each
def test_box_and_ball_satisfy_the_equations_to_leading_order(point):
    """First harmonic of (10.2)'s momentum balance U'' + ... = f sin: the residual must be of order epsilon^2."""

    def residual(epsilon):
        system = SYSTEM.with_(epsilon=epsilon)
        samples = 4096
        tau = system.period * np.arange(samples) / samples
        response = leading_order(system, point, tau)
        harmonic = np.exp(-1j * system.Omega * tau) / samples * 2j
        U, X = harmonic @ response.U, harmonic @ response.X
        omega = system.Omega
        spring = np.array([1.0, system.stiffness2]) * X + system.alpha12 * (X - X[::-1])
        damper = np.array([system.gamma1, system.gamma2]) * X + system.gamma12 * (X - X[::-1])
        return np.abs(-(omega**2) * U + spring + 1j * omega * damper - system.forcing).max()

    assert residual(1e-3) < 30e-6
    assert residual(1e-3) / residual(1e-4) == pytest.approx(100, rel=0.02)
