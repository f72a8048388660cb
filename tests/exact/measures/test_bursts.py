"""Bursts and modulation measures of constructed impacts and of a periodic orbit have known values."""

import numpy as np
import pytest

import vibroimpact as vi
from vibroimpact.exact.measures.modulation import bursts, measures


def test_a_short_flight_a_long_flight_and_a_return_to_the_same_wall_end_a_burst():
    flights = 6.0 * np.array([0.5, 0.5, 0.2, 0.5, 0.6, 0.4, 0.9, 0.5, 0.5, 0.5, 0.5])
    tau = np.concatenate([[0.0], np.cumsum(flights)])
    wall = np.resize([1, -1], 12)
    wall[10:] *= -1  # the ninth flight returns to its wall
    found = bursts(tau, wall, period=6.0)
    np.testing.assert_allclose(found, [[tau[0], tau[2]], [tau[3], tau[6]], [tau[7], tau[9]]])


def test_a_stable_orbit_is_one_burst_without_modulation(chapter):
    system = chapter()
    orbit = next(o for o in vi.orbits(system) if o.admissible and abs(o.multipliers[0]) < 1)
    found = measures(system, orbit.state, 50)
    for module in (1, 2):
        assert found["amplitude variation", module] < 1e-10
        assert found["impacts per cycle", module] == 2
        assert found["sticks per 1000 cycles", module] == 0
        assert found["resonant share", module] == pytest.approx(1, abs=0.02)
        assert found["burst length", module] == pytest.approx(50, abs=1)


def test_a_ball_that_never_impacts_has_no_bursts(chapter):
    found = measures(chapter(0.5, 0.5), np.zeros(8), 100)
    assert found["impacts per cycle", 2] == found["resonant share", 2] == 0
    assert np.isnan(found["burst length", 2])
    assert found["impacts per cycle", 1] > 0
