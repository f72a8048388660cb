"""The onset of a torus by its size against the Neimark-Sacker point by exact multipliers."""

import numpy as np
import pytest

import vibroimpact as vi
from vibroimpact.regimes.branches import Path
from vibroimpact.regimes.torus import onset, size, sweep


def test_sizes_like_a_square_root_are_traced_back_to_their_onset():
    p = np.array([0.6, 0.7, 0.8])
    found, error = onset(p, np.sqrt(3.0 * (0.9 - p)))
    assert found == pytest.approx(0.9, abs=1e-12)
    assert error < 1e-12


def test_a_periodic_motion_has_no_size(chapter):
    system = chapter()
    orbit = next(o for o in vi.orbits(system) if o.admissible and abs(o.multipliers[0]) < 1)
    assert size(system, orbit.state, 50, 10)[0] < 1e-12


def crossing(path, low, high):
    """Where a complex pair of the asymmetric orbit crosses the unit circle: linear between two values next to it."""
    modulus = []
    for p in (low, high):
        pairs = [o for o in vi.orbits(path(p)) if o.admissible and not o.symmetric]
        orbit = min(pairs, key=lambda o: abs(o.multipliers[0]))
        modulus.append(max(abs(mu) for mu in orbit.multipliers if abs(mu.imag) > 1e-6))
    assert modulus[0] > 1 > modulus[1]
    return low + (high - low) * (modulus[0] - 1) / (modulus[0] - modulus[1])


def test_the_torus_begins_at_the_neimark_sacker_point_and_without_hysteresis(chapter):
    """Supercritical: the squared size is linear, vanishes at the point, and is the same on the way down and up."""
    path = Path(chapter(), ("f20_hat",))
    rows = sweep(path, [0.8177, 0.8172, 0.8171, 0.8170, 0.8169], cycles=2000, discarded=12000)
    down, up = ({p: found for name, p, found in rows if name == which} for which in ("down", "up"))
    assert down[0.8177] < 1e-6
    assert up[0.8177] < 1e-6
    values = [p for p in down if p < 0.8173 and down[p] > 1e-3]
    assert len(values) >= 3
    for p in values:
        assert down[p] == pytest.approx(up[p], rel=0.02)
    found, error = onset(values, [down[p] for p in values])
    assert abs(found - crossing(path, 0.8168, 0.8177)) < max(5 * error, 2e-5)


def test_a_sweep_without_an_orbit_begins_at_rest(chapter):
    path = Path(chapter(0.5, 0.5), ("f20_hat",))
    (name, value, found), *_ = sweep(path, [0.5, 0.4], 10, 10)
    pushed = np.zeros(8)
    pushed[[4, 6]] = 1e-3
    assert (name, value, found) == ("down", 0.5, size(path(0.5), pushed, 10, 10)[0])


def test_the_torus_is_gone_a_little_further_on(chapter):
    """From the orbit's own surroundings a motion leaves for the strongly modulated response, many times as large."""
    orbit = next(o for o in vi.orbits(chapter(1.0, 0.8181)) if not o.symmetric and abs(o.multipliers[0]) < 1)
    near = orbit.state + 1e-3 * np.eye(8)[4]
    assert size(chapter(1.0, 0.8165), near, 1000, 6000)[0] < 0.04
    assert size(chapter(1.0, 0.8130), near, 1000, 6000)[0] > 0.3
