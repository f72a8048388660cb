"""Measure the error of a float64 run over time against a run that provably follows the true trajectory."""

import numpy as np

from vibroimpact.exact.engine.simulation import simulate


def departure(system, state, truth: np.ndarray):
    """Return the error of a float64 run from `state`, its estimate by the certificate, and `certificate.horizon`.

    truth: true states (n + 1, 8) at the starts of the forcing cycles 0 to n. The error (n + 1,) is the largest
    difference of any component between the run and `truth` at the start of each cycle. The estimate (n + 1,) is that of
    the error at the same times, inf past `certificate.horizon`. `certificate.horizon`, the time of the first event at
    which the estimate exceeds 1e-3, is returned in forcing cycles; it is inf if the estimate never exceeds 1e-3.
    """
    cycles = len(truth) - 1
    times = np.arange(cycles + 1) * system.period
    whole = simulate(system, state, cycles, sample_times=times)
    difference = np.abs(whole.samples - truth).max(axis=1)
    return difference, whole.errors(times), whole.certificate.horizon / system.period
