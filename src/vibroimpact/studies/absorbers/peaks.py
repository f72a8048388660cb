"""Compute the peak displacement of boxes with balls in a band of frequencies; one cycle in a hundred exceeds the peak.

The largest displacement of a chaotic motion grows with the length of the run. A quantile of the largest displacements
in single cycles does not grow, and is therefore used as the peak. If many peaks are measured, the random error of the
lowest one is likely to be negative. Therefore callers measure the lowest peaks again, from other initial states.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from vibroimpact.exact.engine.event_loop import FINISHED
from vibroimpact.exact.lanes.ensemble import STATUSES, ensemble
from vibroimpact.system import System
from vibroimpact.system.state import inactive_at_rest

QUANTILE = 0.99
"""Fraction of all cycles in which the largest displacement does not exceed the peak."""


@dataclass(frozen=True)
class CycleMaxima:
    """Displacements of the boxes in the observed cycles of runs, for m systems from n initial states each.

    largest: largest |X_1| or |X_2| in each cycle, (m, n, observed cycles); nan for unfinished runs. rms: root mean
    square of a box displacement over the observed cycles of a run; the largest value of both boxes and all finished
    runs. unfinished: number of unfinished runs.
    """

    largest: np.ndarray
    rms: float
    unfinished: int


def peak(systems: Sequence[System], states: ArrayLike, cycles: int, settle: int) -> tuple[float, float]:
    """Return the peak displacement in a band of frequencies, dimensionless, and its standard error.

    `systems` holds one system per frequency. Each system runs from every state of `states`, (n, 8).

    Parameters
    ----------
    cycles, settle : int
        As for `ensemble`: each run lasts `cycles` forcing periods and is observed after the first `settle` of them.

    Raises
    ------
    ArithmeticError
        If a run could not be finished.
    ValueError
        As for `ensemble`.
    """
    runs = by_cycle(systems, states, cycles, settle)
    if runs.unfinished:
        raise ArithmeticError(f"the peak is unknown, since {runs.unfinished} runs could not be finished")
    return float(peak_of(runs.largest).max()), standard_error(runs.largest)


def by_cycle(systems: Sequence[System], states: ArrayLike, cycles: int, settle: int) -> CycleMaxima:
    """Run each system from every state and return the maxima of each cycle; the arguments are those of `peak`.

    An uncoupled module without force (not in `System.modules`) starts at rest.

    Raises
    ------
    ValueError
        If `cycles` is not above `settle`, and in the cases listed for `ensemble`.
    """
    if not cycles > settle:
        raise ValueError(f"cycles: {cycles} is not above settle = {settle}, so that no cycle is left to observe")
    systems, states = np.array(systems, dtype=object), np.array([inactive_at_rest(one, states) for one in systems])
    runs = ensemble(systems[:, None], states, cycles, settle=settle, by_cycle=True)
    largest, squares = runs["largest"].max(axis=-1), runs["mean_square"].sum(axis=-2)
    lost = np.isnan(runs["final"][..., -1, :]).any(axis=-1)
    rms = np.sqrt(np.max(squares[~lost], initial=0.0) / (cycles - settle))
    return CycleMaxima(largest, float(rms), int(np.count_nonzero(lost)))


def peak_of(largest: ArrayLike) -> np.ndarray:
    """For each system, return the peak: the 0.99 quantile of `CycleMaxima.largest` over the cycles of all starts.

    The peak is nan for a system without finished runs.
    """
    largest = np.asarray(largest)
    return np.array(
        [np.quantile(one[~np.isnan(one)], QUANTILE) if not np.isnan(one).all() else np.nan for one in largest]
    )


def standard_error(largest: ArrayLike) -> float:
    """Return the standard error of the highest peak of all systems (see `peak_of`), by a jackknife over the starts.

    The jackknife leaves out one start at a time. It assumes that runs from different starts are independent, but allows
    correlated cycles within a run. The error is large if a single start determines the highest peak, and nan for fewer
    than 2 starts.
    """
    largest = np.asarray(largest)
    count = largest.shape[1]
    if count < 2:
        return float("nan")
    left = np.array([peak_of(np.delete(largest, k, axis=1)).max() for k in range(count)])
    return float(np.sqrt((count - 1) * left.var()))


def finished(runs: np.ndarray) -> np.ndarray:
    """Return the given outcomes of `ensemble` if all runs finished.

    Raises
    ------
    ArithmeticError
        If a run could not be finished.
    """
    failed = runs["status"][runs["status"] != FINISHED]
    if len(failed):
        raise ArithmeticError(f"the peak is unknown, since a run failed: {STATUSES[int(failed[0])]}")
    return runs
