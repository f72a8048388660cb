"""Identify the motion to which a run has settled: period, symmetry, number of impacts.

The functions use displacements (X1, Y1, X2, Y2), evenly sampled with a whole number of samples per forcing period.
Velocities are not used, since they jump at impacts.
"""

import numpy as np


def samples_per_cycle(tau, period: float) -> int:
    """Return the number of samples per forcing period for evenly spaced sample times tau, shape (n,).

    Raises
    ------
    ValueError
        If the times are not evenly spaced, their spacing does not divide the period, or they span less than a period.
    """
    tau = np.asarray(tau, dtype=float)
    if tau.ndim != 1 or len(tau) < 2:
        raise ValueError(f"tau: needs at least 2 times, got shape {tau.shape}")
    step = (tau[-1] - tau[0]) / (len(tau) - 1)
    number = round(period / step) if step > 0 else 0
    slack = 1e-6 * step
    if np.any(np.abs(np.diff(tau) - step) > slack) or abs(number * step - period) > number * slack:
        raise ValueError(
            f"tau: needs evenly spaced times with a whole number of spacings in a period of {period}, "
            f"got a mean spacing of {step}"
        )
    if len(tau) <= number:
        raise ValueError(f"tau: {len(tau)} samples span less than one period; needs at least {number + 1}")
    return number


def distance_after(displacements, per_cycle: int, cycles: int = 1) -> float:
    """Return the largest difference between displacements that are `cycles` forcing periods apart in the window.

    The result is 0 for a motion that repeats after `cycles` periods.

    Parameters
    ----------
    displacements
        Shape (n, k), sampled evenly with per_cycle samples in each forcing period.

    Raises
    ------
    ValueError
        If the window is not longer than `cycles` periods.
    """
    displacements, lag = np.asarray(displacements), cycles * per_cycle
    if not 0 < lag < len(displacements):
        window = len(displacements) / per_cycle
        raise ValueError(f"cycles: must be at least 1 and less than {window:g} (periods in the window), got {cycles}")
    return float(np.max(np.abs(displacements[lag:] - displacements[:-lag])))


def repeats_after(displacements, per_cycle: int, tolerance: float) -> int | None:
    """Return the smallest number of forcing periods after which a motion repeats within a tolerance, or None.

    Only numbers up to half of the window are tried, so that every repetition is observed at least twice.

    Parameters
    ----------
    displacements, per_cycle
        As in `distance_after`.
    """
    displacements = np.asarray(displacements)
    longest = (len(displacements) - 1) // (2 * per_cycle)
    later = displacements[per_cycle : longest * per_cycle + 1 : per_cycle]
    # every n for which the sample after n periods is within the tolerance of the first sample
    back = 1 + np.flatnonzero(np.abs(later - displacements[0]).max(axis=1) <= tolerance)
    return next((int(n) for n in back if distance_after(displacements, per_cycle, n) <= tolerance), None)


def mirror_distance(displacements, per_cycle: int) -> float:
    """Return the largest |x(tau + T/2) + x(tau)| over all displacements x in the window; 0 for a symmetric motion.

    The equations of motion do not change if the state changes its sign and time is shifted by half a period T/2. A
    symmetric motion does not change either.

    Raises
    ------
    ValueError
        If per_cycle is odd, so that half a period is not a whole number of samples.
    """
    if per_cycle % 2:
        raise ValueError(f"per_cycle: {per_cycle} is odd; needs an even number, so that half a period ends at a sample")
    displacements, half = np.asarray(displacements), per_cycle // 2
    return float(np.max(np.abs(displacements[half:] + displacements[:-half])))


def impacts_per_cycle(tau, module, wall, start: float, period: float, cycles: int) -> np.ndarray:
    """Return the number of impacts for each forcing period, module and wall (+1, -1), shape (cycles, 2, 2).

    Parameters
    ----------
    tau, module, wall
        Time, module and wall of each impact, shape (m,).
    start : float
        Time at which the first period begins.
    """
    tau, module, wall = np.asarray(tau), np.asarray(module), np.asarray(wall)
    edges = start + period * np.arange(cycles + 1)
    counts = [[np.histogram(tau[(module == i) & (wall == side)], edges)[0] for side in (1, -1)] for i in (1, 2)]
    return np.moveaxis(np.array(counts), -1, 0)
