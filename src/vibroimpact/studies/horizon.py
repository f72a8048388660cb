"""Measure the error of a float64 run over time against a run that provably follows the true trajectory."""

import numpy as np

from vibroimpact.exact.engine.simulation import simulate


def departure(system, state, truth: np.ndarray):
    """Return the true error of a float64 run from `state`, its estimated error, and the horizon of the estimate.

    truth: true states (n + 1, 8) at the starts of the forcing cycles 0 to n.

    The true error (n + 1,) is the largest difference of any component between the run and `truth` at the start of each
    cycle. The certificate of the run gives the other results. The estimated error (n + 1,) at the start of each cycle
    is inf after the horizon. The horizon is the time of the first event at which the estimated error exceeds 1e-3, in
    forcing cycles; it is inf if there is no such event.
    """
    cycles = len(truth) - 1
    times = np.arange(cycles + 1) * system.period
    whole = simulate(system, state, cycles, sample_times=times)
    difference = np.abs(whole.samples - truth).max(axis=1)
    return difference, whole.errors(times), whole.certificate.horizon / system.period
