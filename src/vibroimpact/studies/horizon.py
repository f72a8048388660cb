"""Measure the error of a float64 run over time against a run that provably follows the true trajectory."""

import numpy as np

from vibroimpact.exact.engine.simulation import simulate


def departure(system, state, truth: np.ndarray):
    """Return the true error, the estimated error and the horizon of a float64 run from `state`.

    truth: true states at the starts of the forcing cycles, shape (n + 1, 8).

    Both errors are arrays of shape (n + 1,), with one value for the start of each cycle. The true error is the largest
    difference from `truth` over all components of the state.

    The horizon is the time of the first event at which the estimated error exceeds 1e-3, in forcing cycles. The end of
    the run counts as an event. If the estimated error stays below 1e-3, the horizon is inf.
    """
    cycles = len(truth) - 1
    times = np.arange(cycles + 1) * system.period
    whole = simulate(system, state, cycles, sample_times=times)
    difference = np.abs(whole.samples - truth).max(axis=1)
    return difference, whole.errors(times), whole.certificate.horizon / system.period
