"""Modulation measures of signals with known envelopes."""

import numpy as np
import pytest

from vibroimpact.exact.measures.modulation import cycle_amplitudes, extreme_depth, swells, variation

PER_CYCLE = 40


def beating(cycles, length, depth):
    cycle = np.arange(cycles * PER_CYCLE) / PER_CYCLE
    return (1 - depth * np.cos(2 * np.pi * cycle / length)) * np.sin(2 * np.pi * cycle)


def test_a_steady_response_is_not_modulated():
    signal = 0.3 * np.sin(2 * np.pi * np.arange(407) / PER_CYCLE)  # ten cycles and an unfinished one
    amplitudes = cycle_amplitudes(signal, PER_CYCLE)
    assert amplitudes == pytest.approx(np.full(10, 0.3), rel=1e-12)
    assert variation(amplitudes) == pytest.approx(0, abs=1e-12)
    assert len(swells(np.ones(10))) == 0
    assert variation(np.zeros(3)) == extreme_depth(np.zeros(3)) == 0


@pytest.mark.parametrize("length", [12, 20, 33])
def test_swells_are_one_modulation_period_apart(length):
    amplitudes = cycle_amplitudes(beating(10 * length, length, 0.5), PER_CYCLE)
    assert variation(amplitudes) == pytest.approx(0.5 / np.sqrt(2), abs=0.03)
    assert extreme_depth(amplitudes) == pytest.approx(0.5, abs=0.05)
    found = swells(amplitudes)
    assert len(found) == 10
    assert np.diff(found).mean() == pytest.approx(length, abs=0.2)


def test_ripples_do_not_count_as_swells():
    slow = 1 - 0.5 * np.cos(2 * np.pi * np.arange(100) / 25)
    ripples = 0.08 * (-1.0) ** np.arange(100)
    assert len(swells(slow + ripples)) == 4


def test_a_maximum_at_the_beginning_of_the_window_is_no_swell():
    assert swells([1.0, 0.9, 0.1, 0.5, 1.0, 0.9, 0.0, 1.0]).tolist() == [4, 7]
