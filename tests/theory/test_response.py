"""The leading-order response and its power: impact conditions, equations of motion, the limit of exact orbits."""

import numpy as np
import pytest

import vibroimpact as vi
from chapter import FORCES, PARAMETERS
from vibroimpact.exact.orbits.search import symmetric_orbit
from vibroimpact.exact.orbits.symmetric import symmetric_solutions
from vibroimpact.theory.response import impact_times, leading_order, mean_power

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


@pytest.mark.parametrize("forces", FORCES.values(), ids=FORCES)
def test_what_the_forces_supply_is_dissipated(forces):
    system = vi.System(**PARAMETERS, f10_hat=forces[0], f20_hat=forces[1])
    for point in vi.fixed_points(system):
        power = mean_power(system, point)
        spent = power.ground.sum() + power.coupling + power.impacts.sum()
        assert power.work.sum() == pytest.approx(spent, rel=1e-11)
        assert 0 < power.impact_share < 1


def test_the_exact_orbits_differ_by_the_order_of_epsilon():
    """Halving epsilon halves the relative error of every part of the power and of the share of the impacts."""

    def parts(power):
        return np.hstack([power.work, power.ground, power.coupling, power.impacts])

    errors = []
    for epsilon in (0.02, 0.01, 0.005):
        system = vi.System(**{**PARAMETERS, "epsilon": epsilon}, f10_hat=1.0, f20_hat=0.89)
        orbits = [symmetric_orbit(system, root) for root in symmetric_solutions(system)]
        found = []
        for point in vi.fixed_points(system):
            orbit = min(orbits, key=lambda orbit, C=point.C: np.abs(orbit.C - C).max())
            assert np.abs(orbit.C - point.C).max() < 6 * epsilon
            exact, expected = vi.simulate(system, orbit.state, 1).energy, mean_power(system, point)
            share = abs(exact.impact_share / expected.impact_share - 1)
            found.append([*np.abs(parts(exact) / (parts(expected) * system.period) - 1), share])
        errors.append(found)
    assert len(errors[0]) == 3
    size, ratios = np.max(errors[-1]), np.max(errors, axis=(1, 2))
    assert size < 0.05
    np.testing.assert_allclose(ratios[:-1] / ratios[1:], 2.0, rtol=0.1)
