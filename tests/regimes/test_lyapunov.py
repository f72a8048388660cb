"""Exponents that are known: a stable orbit's multipliers, two neighbouring motions, two equal uncoupled modules."""

import numpy as np
import pytest

import vibroimpact as vi
from vibroimpact.regimes.lyapunov import largest_exponent


def stable_orbit(system):
    return next(orbit for orbit in vi.orbits(system) if orbit.admissible and abs(orbit.multipliers[0]) < 1)


@pytest.mark.parametrize(("f10", "f20"), [(1.0, 1.0), (1.0, 1.2), (1.3, 1.25)])
def test_on_a_stable_orbit_it_is_the_log_of_the_largest_multiplier(chapter, f10, f20):
    system = chapter(f10, f20)
    orbit = stable_orbit(system)
    blocks, cycles = 400, 10
    found = largest_exponent(system, orbit.state, blocks, cycles).mean
    # A complex pair turns the perturbation: its length swings by a factor that does not grow with time.
    assert found == pytest.approx(np.log(abs(orbit.multipliers[0])), abs=3 / (blocks * cycles))


def test_chaos_separates_neighbours_at_the_rate_of_the_jacobian(chapter):
    """Two simulated motions 1e-8 apart, brought together again every cycle; no derivative enters."""
    system = chapter(0.5, 0.5)
    state = vi.simulate(system, [0, 0, 0, 0, 0, 0.5, 0, 0.4], 300).final
    discarded, cycles = 10, 400
    expected = largest_exponent(system, state, cycles, 1, discarded).mean
    direction, growth = np.full(8, 8**-0.5), []
    for _ in range(discarded + cycles):
        step = 1e-8 * direction
        for i in (0, 2):  # the neighbour may not start beyond a wall
            step = -step if abs(state[i] + step[i] - state[i + 1] - step[i + 1]) > 1 else step
        after, other = vi.simulate(system, state, 1).final, vi.simulate(system, state + step, 1).final
        difference = other - after
        growth.append(np.log(np.linalg.norm(difference) / 1e-8))
        direction, state = difference / np.linalg.norm(difference), after
    assert np.mean(growth[discarded:]) == pytest.approx(expected, abs=0.03)
    assert expected > 0.5


def test_blocks_do_not_matter(chapter):
    """On one stretch of 30 cycles: a longer one is another motion as soon as rounding has grown."""
    system = chapter(1.0, 0.89)
    state = vi.simulate(system, np.zeros(8), 500).final
    assert largest_exponent(system, state, 10, 3, 0).mean == pytest.approx(
        largest_exponent(system, state, 6, 5, 0).mean, rel=1e-4
    )


def test_the_error_is_the_scatter_over_starts(chapter):
    """Twelve stretches of the same chaos differ by as much as the error of each says."""
    system = chapter(0.5, 0.5)
    found = [
        largest_exponent(system, vi.simulate(system, [0, 0, 0, 0, 0, 0.5, 0, 0.3 + 0.01 * k], 300).final, 20, 10)
        for k in range(12)
    ]
    scatter = np.std([exponent.mean for exponent in found], ddof=1)
    error = np.mean([exponent.error for exponent in found])
    assert 0.5 < scatter / error < 2.0


def test_an_error_needs_two_blocks(chapter):
    with pytest.raises(ValueError, match="blocks"):
        largest_exponent(chapter(), np.zeros(8), 1, 10)
