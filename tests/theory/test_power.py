"""The power balance at fixed points: closed, and the limit of what the exact orbits do."""

import numpy as np
import pytest

import vibroimpact as vi
from chapter import FORCES, PARAMETERS
from vibroimpact.exact.orbits.search import symmetric_orbit
from vibroimpact.exact.orbits.symmetric import symmetric_solutions
from vibroimpact.theory.power import mean_power


def balance(power):
    """Its five kinds of numbers, both modules apart, shape (7,)."""
    return np.hstack([power.work, power.ground, power.coupling, power.impacts])


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
            found.append([*np.abs(balance(exact) / (balance(expected) * system.period) - 1), share])
        errors.append(found)
    assert len(errors[0]) == 3
    size, ratios = np.max(errors[-1]), np.max(errors, axis=(1, 2))
    assert size < 0.05
    np.testing.assert_allclose(ratios[:-1] / ratios[1:], 2.0, rtol=0.1)
