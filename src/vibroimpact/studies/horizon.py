"""Measure the error of a float64 run over time against a run that provably follows the true trajectory."""

import numpy as np

from vibroimpact.exact.engine.simulation import simulate


def departure(system, state, truth: np.ndarray):
    """Return the true error of a float64 run from `state`, the estimated error, and the horizon of the run.

    truth: true states (n + 1, 8) at the starts of the forcing cycles 0 to n.

    The true error and the estimated error have one value at the start of each cycle, shape (n + 1,). The true error is
    the largest difference of any component of the state between the run and `truth`. The horizon [forcing
    cycles] is the time of the first event at which the estimated error exceeds 1e-3; the end of the run counts as an
    event. The horizon is inf if the estimated error never exceeds 1e-3. After the horizon the estimated error is inf.
    """
    cycles = len(truth) - 1
    times = np.arange(cycles + 1) * system.period
    whole = simulate(system, state, cycles, sample_times=times)
    difference = np.abs(whole.samples - truth).max(axis=1)
    return difference, whole.errors(times), whole.certificate.horizon / system.period
