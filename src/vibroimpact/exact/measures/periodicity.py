"""Identify the motion to which a run has settled: period, symmetry, number of impacts.

Displacements (X1, Y1, X2, Y2) are sampled evenly, a whole number of times per forcing period. Velocities are not used,
since they jump at impacts.
"""

import numpy as np


def samples_per_cycle(tau, period: float) -> int:
    """Return the number of samples per forcing period for evenly spaced times tau, shape (n,).

    Raise ValueError if the spacing is uneven or does not divide the period, or if tau spans less than a period.
    """
    tau = np.asarray(tau, dtype=float)
    if tau.ndim != 1 or len(tau) < 2:
        raise ValueError(f"tau: needs two or more sample times, got shape {tau.shape}")
    step = (tau[-1] - tau[0]) / (len(tau) - 1)
    number = round(period / step) if step > 0 else 0
    slack = 1e-6 * step
    if np.any(np.abs(np.diff(tau) - step) > slack) or abs(number * step - period) > number * slack:
        raise ValueError(
            f"tau: needs evenly spaced times whose spacing divides the period {period}, got a mean spacing of {step}"
        )
    if len(tau) <= number:
        raise ValueError(f"tau: {len(tau)} samples span less than one period; needs at least {number + 1}")
    return number


def distance_after(displacements, per_cycle: int, cycles: int = 1) -> float:
    """Return the largest difference between displacements that are `cycles` forcing periods apart.

    displacements: samples of k displacements, shape (n, k), with `per_cycle` samples in each period. Raise ValueError
    if `cycles` is below 1 or if the samples do not span more than `cycles` periods.
    """
    displacements, lag = np.asarray(displacements), cycles * per_cycle
    if not 0 < lag < len(displacements):
        window = len(displacements) / per_cycle
        raise ValueError(f"cycles: must be above 0 and below the number of sampled periods, {window:g}; got {cycles}")
    return float(np.max(np.abs(displacements[lag:] - displacements[:-lag])))


def repeats_after(displacements, per_cycle: int, tolerance: float) -> int | None:
    """Return the smallest number of forcing periods after which a motion repeats within a tolerance.

    Only numbers up to half the number of sampled periods are tried. If none of them fits, the result is None.
    displacements: samples of k displacements, shape (n, k), with `per_cycle` samples in each period.
    """
    displacements = np.asarray(displacements)
    longest = (len(displacements) - 1) // (2 * per_cycle)
    later = displacements[per_cycle : longest * per_cycle + 1 : per_cycle]
    # After each of these numbers of periods, the sample is close to the first sample.
    back = 1 + np.flatnonzero(np.abs(later - displacements[0]).max(axis=1) <= tolerance)
    return next((int(n) for n in back if distance_after(displacements, per_cycle, n) <= tolerance), None)


def mirror_distance(displacements, per_cycle: int) -> float:
    """Return the largest |x(tau + T/2) + x(tau)| over all displacements x and sample times tau.

    The result is 0 for a symmetric motion. T is the forcing period. Raise ValueError if `per_cycle`, the number of
    samples in a period, is odd.
    """
    if per_cycle % 2:
        raise ValueError(f"per_cycle: {per_cycle} is odd; needs an even number, so that half a period ends at a sample")
    displacements, half = np.asarray(displacements), per_cycle // 2
    return float(np.max(np.abs(displacements[half:] + displacements[:-half])))


def impacts_per_cycle(tau, module, wall, start: float, period: float, cycles: int) -> np.ndarray:
    """Return the number of impacts for each forcing period, module and wall (+1, -1), shape (cycles, 2, 2).

    tau, module, wall: time, module and wall of each impact, shape (m,). start: time at which the first period starts.
    """
    tau, module, wall = np.asarray(tau), np.asarray(module), np.asarray(wall)
    edges = start + period * np.arange(cycles + 1)
    counts = [[np.histogram(tau[(module == i) & (wall == side)], edges)[0] for side in (1, -1)] for i in (1, 2)]
    return np.moveaxis(np.array(counts), -1, 0)
