"""Measure the error of a float64 run over time against a run that provably follows the true trajectory."""

import numpy as np

from vibroimpact.exact.engine.simulation import simulate


def departure(system, state, truth: np.ndarray):
    """Return the true error, the estimated error and the horizon of a float64 run from `state`.

    truth: true states (n + 1, 8) at the starts of the forcing cycles.

    Both errors have shape (n + 1,). The true error is the largest difference in any component. The horizon [forcing
    cycles] is the time of the first event (or the end) at which the estimated error exceeds 1e-3, else inf.
    """
    cycles = len(truth) - 1
    times = np.arange(cycles + 1) * system.period
    whole = simulate(system, state, cycles, sample_times=times)
    difference = np.abs(whole.samples - truth).max(axis=1)
    return difference, whole.errors(times), whole.certificate.horizon / system.period
