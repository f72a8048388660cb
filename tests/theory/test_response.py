"""The leading-order response satisfies impact conditions and equations of motion, and is the limit of exact orbits."""

import numpy as np
import pytest

import vibroimpact as vi
from chapter import FORCES, system_of
from mean_power import mean_power
from vibroimpact.exact.orbits.search import symmetric_orbit
from vibroimpact.exact.orbits.symmetric import symmetric_solutions
from vibroimpact.theory.response import impact_times, leading_order

SYSTEM = system_of("equal")
POINTS = vi.fixed_points(SYSTEM)
each = pytest.mark.parametrize("point", POINTS, ids=range(len(POINTS)))


@each
def test_U_and_W_follow_from_X_and_Y(point):
    response = leading_order(SYSTEM, point, np.linspace(-3, 40, 101))
    assert response.X + SYSTEM.epsilon * response.Y == pytest.approx(response.U, abs=1e-14)
    assert np.abs(response.X - response.Y - response.W).max() < 1e-14
    assert response.U.shape == (101, 2)


@each
@pytest.mark.parametrize("module", [0, 1])
def test_impacts_are_at_the_walls_and_obey_restitution(point, module):
    for wall, shift in ((1, 0.0), (-1, SYSTEM.period / 2)):
        time, h = impact_times(SYSTEM, point)[module] + shift, 1e-6 * SYSTEM.period
        W = leading_order(SYSTEM, point, time + h * np.array([-2, -1, 0, 1, 2])).W[:, module]
        assert W[2] == pytest.approx(wall, abs=1e-12)
        before, after = (W[1] - W[0]) / h, (W[4] - W[3]) / h
        assert after == pytest.approx(-SYSTEM.kappa * before, abs=2e-5)
        assert wall * before > 0


@each
def test_box_and_ball_satisfy_the_equations_to_leading_order(point):
    """The residual in the first harmonic of the momentum balance U'' + ... = f sin of (10.2) is O(epsilon^2)."""

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


@pytest.mark.parametrize("case", FORCES)
def test_the_power_of_the_forces_is_dissipated(case):
    system = system_of(case)
    for point in vi.fixed_points(system):
        power = mean_power(system, point)
        dissipated = power.ground.sum() + power.coupling + power.impacts.sum()
        assert power.work.sum() == pytest.approx(dissipated, rel=1e-11)
        assert 0 < power.impact_share < 1


def test_the_power_differs_from_that_of_exact_orbits_by_the_order_of_epsilon():
    """If epsilon is halved, the relative errors of all parts of the power and of the impact share are halved."""

    def parts(power):
        return np.hstack([power.work, power.ground, power.coupling, power.impacts])

    errors = []
    for epsilon in (0.02, 0.01, 0.005):
        system = system_of("unequal", epsilon=epsilon)
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
