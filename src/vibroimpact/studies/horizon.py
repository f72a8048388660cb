"""Measure the error of a float64 run over time against a run that provably follows the true trajectory."""

import numpy as np

from vibroimpact.exact.engine.simulation import simulate


def departure(system, state, truth: np.ndarray):
    """Return the error of a float64 run, the estimate of this error by the run's certificate, and the horizon.

    truth: (n + 1, 8) true states at the starts of cycles 0 to n, tau = 0 first. Error: largest difference of any
    component at each of these times, (n + 1,). Estimate: at the same times, (n + 1,), inf past the horizon. Horizon: in
    forcing cycles, inf if it is not reached.
    """
    cycles = len(truth) - 1
    times = np.arange(cycles + 1) * system.period
    whole = simulate(system, state, cycles, sample_times=times)
    difference = np.abs(whole.samples - truth).max(axis=1)
    return difference, whole.errors(times), whole.certificate.horizon / system.period
