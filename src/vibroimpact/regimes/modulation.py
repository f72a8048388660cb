"""Measures of a modulated response."""

import numpy as np


def cycle_amplitudes(values, per_cycle: int) -> np.ndarray:
    """Half the peak-to-peak value in each whole forcing period, shape (cycles,), of evenly sampled values (n,)."""
    cycles = len(values) // per_cycle
    by_cycle = np.asarray(values)[: cycles * per_cycle].reshape(cycles, per_cycle)
    return 0.5 * (by_cycle.max(axis=1) - by_cycle.min(axis=1))


def modulation_depth(amplitudes) -> float:
    """(largest - smallest) / (largest + smallest) amplitude: 0 for a steady response, 1 if it dies out between."""
    largest, smallest = np.max(amplitudes), np.min(amplitudes)
    return float((largest - smallest) / (largest + smallest)) if largest > 0 else 0.0


def swells(amplitudes, low: float = 0.35, high: float = 0.65) -> np.ndarray:
    """Cycles at which the amplitude has swollen: risen above `high` of its range since it was last below `low`.

    The two thresholds (parts of the range between smallest and largest amplitude) keep ripples from counting.
    Returns indices, shape (s,); their distances are the modulation periods. Empty for a steady response.
    """
    amplitudes = np.asarray(amplitudes, dtype=float)
    lowest, span = np.min(amplitudes), np.ptp(amplitudes)
    if span == 0:
        return np.empty(0, dtype=int)
    level = (amplitudes - lowest) / span
    starts, armed = [], False
    for cycle, height in enumerate(level):
        if armed and height > high:
            starts.append(cycle)
        armed = height < low or (armed and height <= high)
    return np.array(starts, dtype=int)
