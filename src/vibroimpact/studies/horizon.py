"""Error of a float64 run over time, measured against a run that is proved to follow the true trajectory."""

import numpy as np

from vibroimpact.exact.engine.simulation import simulate


def departure(system, state, truth: np.ndarray):
    """Return the distance of the float64 run from the truth, and the estimate of it by the run's own certificate.

    truth: (n + 1, 8) true states at the starts of cycles 0 to n, tau = 0 first. Returns the largest difference of a
    state's component at each of these times (n + 1,), the certificate's error there (n + 1,), inf past the horizon,
    and the horizon in forcing cycles (inf if it is not reached).
    """
    cycles = len(truth) - 1
    times = np.arange(cycles + 1) * system.period
    whole = simulate(system, state, cycles, sample_times=times)
    difference = np.abs(whole.samples - truth).max(axis=1)
    return difference, whole.errors(times), whole.certificate.horizon / system.period
