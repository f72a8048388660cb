"""The limit of small epsilon: first order everywhere, and the order that is fitted."""

import numpy as np
import pytest

import vibroimpact as vi
from vibroimpact.regimes.epsilon_limit import compare, order


def test_the_order_of_a_power_law():
    epsilon = np.geomspace(0.1, 1e-4, 7)
    slope, error = order(epsilon, 3 * epsilon**1.5)
    assert slope == pytest.approx(1.5, abs=1e-12)
    assert error < 1e-10
    noisy = epsilon * np.exp(0.1 * np.sin(5 * np.arange(7)))
    slope, error = order(epsilon, noisy)
    assert abs(slope - 1) < 3 * error


def test_an_order_needs_points():
    with pytest.raises(ValueError, match="epsilon"):
        order(np.array([0.1]), np.array([0.1]))


@pytest.mark.parametrize(("f10", "f20"), [(1.0, 1.0), (0.5, 0.5)])
def test_errors_shrink_tenfold_with_epsilon(chapter, f10, f20):
    """The slow flow's eigenvalues, the impact map's multipliers and the fixed points are each right to first order."""
    for point in vi.fixed_points(chapter(f10, f20)):
        found = [compare(chapter(f10, f20, epsilon=epsilon), point) for epsilon in (1e-3, 1e-4)]
        distances = [c.distance for c in found]
        slow = [abs(c.rates - c.predicted)[:4].max() for c in found]
        fast = [abs(c.multipliers - c.predicted_multipliers)[4:].max() for c in found]
        for errors in (distances, slow, fast):
            assert errors[0] / errors[1] == pytest.approx(10, rel=0.1)


def test_every_multiplier_is_paired_once(chapter):
    system = chapter(epsilon=0.01)
    for point in vi.fixed_points(system):
        found = compare(system, point)
        orbit = min((o for o in vi.orbits(system) if o.symmetric), key=lambda o: abs(o.C - point.C).max())
        np.testing.assert_allclose(np.sort_complex(found.multipliers), np.sort_complex(orbit.multipliers), rtol=1e-9)
