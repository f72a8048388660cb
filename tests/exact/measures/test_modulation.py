"""Modulation measures on signals whose envelope is known."""

import numpy as np
import pytest

import vibroimpact as vi
from vibroimpact.exact.measures.modulation import cycle_amplitudes, extreme_depth, sampled, swells, variation

PER_CYCLE = 40


def beating(cycles, length, depth):
    cycle = np.arange(cycles * PER_CYCLE) / PER_CYCLE
    return (1 - depth * np.cos(2 * np.pi * cycle / length)) * np.sin(2 * np.pi * cycle)


def test_a_steady_response_is_not_modulated():
    amplitudes = cycle_amplitudes(0.3 * np.sin(2 * np.pi * np.arange(400) / PER_CYCLE), PER_CYCLE)
    assert amplitudes == pytest.approx(np.full(10, 0.3), rel=1e-12)
    assert variation(amplitudes) == pytest.approx(0, abs=1e-12)
    assert len(swells(np.ones(10))) == 0
    assert variation(np.zeros(3)) == extreme_depth(np.zeros(3)) == 0


def test_an_unfinished_cycle_is_left_out():
    assert len(cycle_amplitudes(np.zeros(10 * PER_CYCLE + 7), PER_CYCLE)) == 10


@pytest.mark.parametrize("length", [12, 20, 33])
def test_swells_are_one_modulation_period_apart(length):
    amplitudes = cycle_amplitudes(beating(10 * length, length, 0.5), PER_CYCLE)
    assert variation(amplitudes) == pytest.approx(0.5 / np.sqrt(2), abs=0.03)
    assert extreme_depth(amplitudes) == pytest.approx(0.5, abs=0.05)
    found = swells(amplitudes)
    assert len(found) == 10
    assert np.diff(found).mean() == pytest.approx(length, abs=0.2)


def test_ripples_on_a_swell_are_not_counted():
    slow = 1 - 0.5 * np.cos(2 * np.pi * np.arange(100) / 25)
    ripples = 0.08 * (-1.0) ** np.arange(100)
    assert len(swells(slow + ripples)) == 4


def test_a_window_that_begins_high_counts_from_the_next_swell():
    assert swells([1.0, 0.9, 0.1, 0.5, 1.0, 0.9, 0.0, 1.0]).tolist() == [4, 7]


def test_variation_tends_to_a_limit_where_the_depth_from_extremes_grows(chapter):
    """Over 100, 1000 and 10 000 cycles of the strongly modulated response."""
    system = chapter(0.5, 0.5)
    start = vi.simulate(system, [0, 0, 0, 0, 0, 0.5, 0, 0.5], 500).final
    run = sampled(system, start, 10000)
    for box in (0, 2):
        amplitudes = cycle_amplitudes(run.samples[:, box], 24)
        parts = {cycles: amplitudes.reshape(-1, cycles) for cycles in (100, 1000, 10000)}
        found = {cycles: np.array([variation(part) for part in each]) for cycles, each in parts.items()}
        for cycles in (100, 1000):
            scatter = found[cycles].std(ddof=1)
            assert abs(found[cycles].mean() - found[10000][0]) < 4 * scatter / np.sqrt(len(found[cycles])) + 3 / cycles
        assert found[1000].std(ddof=1) < 0.6 * found[100].std(ddof=1)
        depths = [np.mean([extreme_depth(part) for part in each]) for each in parts.values()]
        assert depths[0] + 0.03 < depths[1] < depths[2]
