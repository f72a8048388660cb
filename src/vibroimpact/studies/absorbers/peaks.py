"""Compute the peak displacement of boxes with balls in a band of frequencies.

The peak is the displacement that is exceeded in one cycle of a hundred. The largest displacement of a chaotic motion
grows with the length of the run, but the peak does not.

If many peaks are measured, the random error of the lowest peak is probably negative. Therefore callers measure the
lowest peaks again, from other initial states.
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
    """Displacements of the boxes in the observed cycles of runs.

    Each of m systems runs from each of n initial states.

    largest: larger of max |X_1| and max |X_2| in each observed cycle, shape (m, n, cycles); nan for unfinished runs.
    rms: largest of the root mean squares of X_1 and X_2, each over the observed cycles of one finished run.
    unfinished: number of unfinished runs.
    """

    largest: np.ndarray
    rms: float
    unfinished: int


def peak(systems: Sequence[System], states: ArrayLike, cycles: int, settle: int) -> tuple[float, float]:
    """Return the peak displacement in a band of frequencies, and its standard error.

    systems: one system per frequency.
    states: initial states, shape (n, 8). Each system runs from each initial state.
    cycles: number of forcing periods of a run.
    settle: number of forcing periods of a run before the observation.

    Raises
    ------
    ArithmeticError
        If a run could not be finished.
    """
    runs = by_cycle(systems, states, cycles, settle)
    if runs.unfinished:
        raise ArithmeticError(f"the peak is unknown, since {runs.unfinished} runs could not be finished")
    return float(peak_of(runs.largest).max()), standard_error(runs.largest)


def by_cycle(systems: Sequence[System], states: ArrayLike, cycles: int, settle: int) -> CycleMaxima:
    """Run each system from every state, and return the largest displacements in each cycle.

    The arguments are those of `peak`. A module that no force drives, directly or through the coupling, starts at rest.
    """
    if not cycles > settle:
        raise ValueError(f"cycles: must be greater than settle = {settle}, got {cycles}; no cycle would be observed")
    systems, states = np.array(systems, dtype=object), np.array([inactive_at_rest(one, states) for one in systems])
    runs = ensemble(systems[:, None], states, cycles, settle=settle, by_cycle=True)
    largest, squares = runs["largest"].max(axis=-1), runs["mean_square"].sum(axis=-2)
    lost = np.isnan(runs["final"][..., -1, :]).any(axis=-1)
    rms = np.sqrt(np.max(squares[~lost], initial=0.0) / (cycles - settle))
    return CycleMaxima(largest, float(rms), int(np.count_nonzero(lost)))


def peak_of(largest: ArrayLike) -> np.ndarray:
    """Return the peak of each system: the 0.99 quantile of `largest` over all runs and cycles of the system.

    largest: as in `CycleMaxima`. If a system has no finished run, its peak is nan.
    """
    largest = np.asarray(largest)
    return np.array(
        [np.quantile(one[~np.isnan(one)], QUANTILE) if not np.isnan(one).all() else np.nan for one in largest]
    )


def standard_error(largest: ArrayLike) -> float:
    """Return the standard error of the highest peak of all systems.

    The error is computed by a jackknife: each initial state is left out once.
    Runs from different initial states must be independent. The error is nan for a single initial state.
    """
    largest = np.asarray(largest)
    count = largest.shape[1]
    if count < 2:
        return float("nan")
    left = np.array([peak_of(np.delete(largest, k, axis=1)).max() for k in range(count)])
    return float(np.sqrt((count - 1) * left.var()))


def finished(runs: np.ndarray) -> np.ndarray:
    """Return the outcomes `runs` of `ensemble` unchanged; raise ArithmeticError if a run could not be finished."""
    failed = runs["status"][runs["status"] != FINISHED]
    if len(failed):
        raise ArithmeticError(f"the peak is unknown, since a run failed: {STATUSES[int(failed[0])]}")
    return runs
