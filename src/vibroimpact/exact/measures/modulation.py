"""Measure modulated responses: amplitudes per cycle, their variation, bursts of resonance."""

import numpy as np

from vibroimpact.exact.engine.simulation import Run, simulate
from vibroimpact.system.state import IMPACT, STICK

PER_CYCLE = 24
"""Samples per forcing period used for amplitudes."""


def cycle_amplitudes(values, per_cycle: int) -> np.ndarray:
    """Return half the peak-to-peak value in each whole forcing period, shape (cycles,).

    `values` has shape (n,), with `per_cycle` values in each period.
    """
    cycles = len(values) // per_cycle
    by_cycle = np.asarray(values)[: cycles * per_cycle].reshape(cycles, per_cycle)
    return 0.5 * (by_cycle.max(axis=1) - by_cycle.min(axis=1))


def variation(amplitudes) -> float:
    """Return the standard deviation of the amplitudes over their mean.

    It is 0 for a steady response and d / sqrt(2) for a beat 1 + d cos.

    It converges with the length of the window, unlike the depth from the largest and smallest amplitude.
    """
    mean = np.mean(amplitudes)
    return float(np.std(amplitudes) / mean) if mean > 0 else 0.0


def extreme_depth(amplitudes) -> float:
    """Return (largest - smallest) / (largest + smallest) amplitude.

    This measure grows with the window and is kept for comparison.
    """
    largest, smallest = np.max(amplitudes), np.min(amplitudes)
    return float((largest - smallest) / (largest + smallest)) if largest > 0 else 0.0


def swells(amplitudes, low: float = 0.35, high: float = 0.65) -> np.ndarray:
    """Return the cycles at which the amplitude has swollen.

    A swell begins where the amplitude rises above `high` of its range after it was below `low`.

    Two thresholds (fractions of the range between smallest and largest amplitude) exclude ripples.
    Returns indices into the amplitudes (n,), shape (s,): their distances are the modulation periods. Empty for a
    steady response.
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


def bursts(tau, wall, period: float, least: int = 2) -> np.ndarray:
    """Return the resonant bursts of one ball, from its impacts in order: start and end times, shape (b, 2).

    A flight is resonant if it leads to the opposite wall and lasts between a quarter and three quarters of the forcing
    period; a burst is an unbroken sequence of at least `least` resonant flights.

    Parameters
    ----------
    tau, wall
        Time and wall of each impact, shape (m,).
    """
    tau, wall = np.asarray(tau), np.asarray(wall)
    duration = np.diff(tau)
    resonant = (np.diff(wall) != 0) & (0.25 * period <= duration) & (duration <= 0.75 * period)
    edges = np.flatnonzero(np.diff(np.concatenate([[False], resonant, [False]]).astype(int)))
    first, last = edges[0::2], edges[1::2]
    long = last - first >= least
    return np.stack([tau[first[long]], tau[last[long]]], axis=1)


def bursts_in(run: Run, module: int) -> np.ndarray:
    """Return the resonant bursts of a module's ball in a run: start and end time of each, shape (b, 2)."""
    mine = run.events[(run.events["module"] == module) & (run.events["kind"] == IMPACT)]
    return bursts(mine["tau"], mine["wall"], run.system.period)


def sampled(system, state, cycles: int) -> Run:
    """Return a run over `cycles` forcing cycles from a state at the start of a cycle.

    It has PER_CYCLE samples in each cycle and one at the end.
    """
    return simulate(system, state, cycles, sample_times=np.arange(cycles * PER_CYCLE + 1) * (system.period / PER_CYCLE))


def measures(system, state, cycles: int) -> dict[tuple[str, int], float]:
    """Return measures of a modulated motion by (quantity, module), over `cycles` forcing cycles.

    The state is that at the start of a cycle. "amplitude variation" is that of the box, cycle by cycle (`variation`);
    "resonant share" is the fraction of the time within bursts (`bursts`); "burst length" is their mean [cycles], nan
    without bursts. Impacts are counted per cycle, sticks per 1000 cycles.
    """
    run = sampled(system, state, cycles)
    found = {}
    for module in (1, 2):
        mine = run.events[run.events["module"] == module]
        amplitudes = cycle_amplitudes(run.samples[:, 2 * module - 2], PER_CYCLE)
        lengths = np.diff(bursts_in(run, module), axis=1)[:, 0] / system.period
        found |= {
            ("amplitude variation", module): variation(amplitudes),
            ("impacts per cycle", module): np.count_nonzero(mine["kind"] == IMPACT) / cycles,
            ("sticks per 1000 cycles", module): 1000 * np.count_nonzero(mine["kind"] == STICK) / cycles,
            ("resonant share", module): float(lengths.sum() / cycles),
            ("burst length", module): float(lengths.mean()) if len(lengths) else np.nan,
        }
    return found


def mean_and_error(values) -> tuple[float, float, int]:
    """Return the mean over starts, its standard error and the number of starts that have the quantity.

    The error of a single start is nan.
    """
    values = np.asarray(values, dtype=float)
    values = values[np.isfinite(values)]
    error = values.std(ddof=1) / np.sqrt(len(values)) if len(values) > 1 else np.nan
    return (float(values.mean()) if len(values) else np.nan), float(error), len(values)
