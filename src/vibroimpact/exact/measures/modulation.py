"""Measure modulated responses: amplitude in each cycle, variation of the amplitude, bursts of resonance."""

import numpy as np

from vibroimpact.exact.engine.simulation import Run, simulate
from vibroimpact.system.state import IMPACT, STICK

PER_CYCLE = 24
"""Number of samples per forcing period from which amplitudes are computed."""
_LOW, _HIGH = 0.35, 0.65


def cycle_amplitudes(values, per_cycle: int) -> np.ndarray:
    """Return half the peak-to-peak value in each complete forcing period, shape (cycles,).

    values: shape (n,), with `per_cycle` values in each period.
    """
    cycles = len(values) // per_cycle
    by_cycle = np.asarray(values)[: cycles * per_cycle].reshape(cycles, per_cycle)
    return 0.5 * (by_cycle.max(axis=1) - by_cycle.min(axis=1))


def variation(amplitudes) -> float:
    """Return the standard deviation of the amplitudes divided by their mean.

    The result is 0 for a steady response and d / sqrt(2) for a beat with the amplitudes 1 + d cos(...).
    """
    mean = np.mean(amplitudes)
    return float(np.std(amplitudes) / mean) if mean > 0 else 0.0


def extreme_depth(amplitudes) -> float:
    """Return the modulation depth (largest - smallest) / (largest + smallest) of the amplitudes.

    If amplitudes of further cycles are added, the depth stays equal or grows.
    """
    largest, smallest = np.max(amplitudes), np.min(amplitudes)
    return float((largest - smallest) / (largest + smallest)) if largest > 0 else 0.0


def swells(amplitudes) -> np.ndarray:
    """Return the indices of the cycles in which a swell of the amplitude begins, shape (s,).

    The amplitudes are scaled, so that the smallest amplitude is 0 and the largest is 1. A swell begins when the scaled
    amplitude rises above 0.65 after it was below 0.35.
    """
    amplitudes = np.asarray(amplitudes, dtype=float)
    lowest, span = np.min(amplitudes), np.ptp(amplitudes)
    if span == 0:
        return np.empty(0, dtype=int)
    level = (amplitudes - lowest) / span
    starts, armed = [], False
    for cycle, height in enumerate(level):
        if armed and height > _HIGH:
            starts.append(cycle)
        armed = height < _LOW or (armed and height <= _HIGH)
    return np.array(starts, dtype=int)


def bursts(tau, wall, period: float) -> np.ndarray:
    """Return the start and end time of each resonant burst of one ball, shape (b, 2).

    A flight is resonant if it leads to the opposite wall in 1/4 to 3/4 of a forcing period. A burst consists of at
    least two successive resonant flights.

    tau, wall: time and wall of each impact of the ball, shape (m,).
    """
    tau, wall = np.asarray(tau), np.asarray(wall)
    duration = np.diff(tau)
    resonant = (np.diff(wall) != 0) & (0.25 * period <= duration) & (duration <= 0.75 * period)
    edges = np.flatnonzero(np.diff(np.concatenate([[False], resonant, [False]]).astype(int)))
    first, last = edges[0::2], edges[1::2]
    long = last - first >= 2
    return np.stack([tau[first[long]], tau[last[long]]], axis=1)


def bursts_in(run: Run, module: int) -> np.ndarray:
    """Return the start and end time of each resonant burst of a module's ball in a run, shape (b, 2)."""
    mine = run.events[(run.events["module"] == module) & (run.events["kind"] == IMPACT)]
    return bursts(mine["tau"], mine["wall"], run.system.period)


def sampled(system, state, cycles: int) -> Run:
    """Return a run from a state at tau = 0, with PER_CYCLE samples in each cycle and one at the end."""
    return simulate(system, state, cycles, sample_times=np.arange(cycles * PER_CYCLE + 1) * (system.period / PER_CYCLE))


def measures(system, state, cycles: int) -> dict[tuple[str, int], float]:
    """Return {(quantity, module): value} for a modulated motion that starts from `state` at tau = 0.

    "amplitude variation" is the `variation` of the box amplitude. "resonant share" is the fraction of time that the
    `bursts` take. "burst length" is the mean length of a burst in cycles; it is nan if there are no bursts. The other
    quantities are "impacts per cycle" and "sticks per 1000 cycles".
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
    """Return (mean, standard error of the mean, number of values), computed from the finite values only.

    If there are no finite values, the mean is nan. If there are fewer than two finite values, the error is nan.
    """
    values = np.asarray(values, dtype=float)
    values = values[np.isfinite(values)]
    error = values.std(ddof=1) / np.sqrt(len(values)) if len(values) > 1 else np.nan
    return (float(values.mean()) if len(values) else np.nan), float(error), len(values)
