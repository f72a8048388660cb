"""The peak with balls over a band of frequencies: the displacement that one cycle in a hundred exceeds.

The largest displacement of a chaotic motion depends on how long one looks. The largest of each cycle has a
distribution, whose quantiles do not. The lowest of many measured peaks is still too low, since it is chosen where
chance was kind; so it is measured again, from other starts, once its place is chosen.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from vibroimpact.exact.engine.event_loop import FINISHED
from vibroimpact.exact.lanes.ensemble import STATUSES, ensemble
from vibroimpact.system import System
from vibroimpact.system.state import idle_at_rest

PART = 0.99
"""Part of the cycles whose largest displacement is at most the peak."""


@dataclass(frozen=True)
class Peak:
    """The peak over a band of frequencies, dimensionless.

    value: see `peak_of`. error: its standard error. largest: the largest |X_i| that was seen; it grows with the number
    of cycles where the motion is chaotic. at: number of the system, along the band, where the peak is met.
    """

    value: float
    error: float
    largest: float
    at: int


@dataclass(frozen=True)
class Cycles:
    """Runs of m systems from n states, cycle by cycle.

    largest: (m, n, cycles), the larger |X_i| of both boxes in each; nan of runs that could not be finished. final:
    (m, n, 8). rms: the largest root mean square of both boxes. unfinished: number of such runs.
    """

    largest: np.ndarray
    final: np.ndarray
    rms: float
    unfinished: int


def peak(systems: Sequence[System], states: ArrayLike, cycles: int, settle: int) -> Peak:
    """Return the peak of systems along a band, each from all states (n, 8).

    Parameters
    ----------
    cycles, settle : int
        Of `ensemble`; a run is observed after `settle` cycles.

    Raises
    ------
    ArithmeticError
        If a run could not be finished.
    ValueError
        As `ensemble`.
    """
    runs = by_cycle(systems, states, cycles, settle)
    if runs.unfinished:
        raise ArithmeticError(f"a peak cannot be measured: {runs.unfinished} runs could not be finished")
    heights = peak_of(runs.largest)
    at = int(heights.argmax())
    return Peak(float(heights[at]), standard_error(runs.largest), float(runs.largest.max()), at)


def by_cycle(systems: Sequence[System], states: ArrayLike, cycles: int, settle: int) -> Cycles:
    """Observe runs of systems, each from all states (n, 8), cycle by cycle; see `peak`.

    A module that takes no part is put at rest.

    Raises
    ------
    ValueError
        If no cycle is observed, or as `ensemble`.
    """
    if not cycles > settle:
        raise ValueError(f"cycles: {cycles} with {settle} to settle leave none to observe")
    systems, states = np.array(systems, dtype=object), np.array([idle_at_rest(one, states) for one in systems])
    runs = ensemble(systems[:, None], states, cycles, settle=settle, by_cycle=True)
    largest, final, squares = runs["largest"].max(axis=-1), runs["final"][..., -1, :], runs["mean_square"].sum(axis=-2)
    lost = np.isnan(final).any(axis=-1)
    rms = np.sqrt(np.max(squares[~lost], initial=0.0) / (cycles - settle))
    return Cycles(largest, final, float(rms), int(np.count_nonzero(lost)))


def peak_of(largest: ArrayLike) -> np.ndarray:
    """Return the quantile PART of `Cycles.largest` over the cycles of all starts, at each system.

    The result is nan without any cycle.
    """
    largest = np.asarray(largest)
    return np.array([np.quantile(one[~np.isnan(one)], PART) if not np.isnan(one).all() else np.nan for one in largest])


def standard_error(largest: ArrayLike) -> float:
    """Return the standard error of the highest `peak_of` all systems: the jackknife, one start left out at a time.

    It takes the starts as drawn independently; it does not take their cycles so, which are not. Where a peak is that
    of a single start it is large. nan with fewer than 2 starts.
    """
    largest = np.asarray(largest)
    count = largest.shape[1]
    if count < 2:
        return float("nan")
    left = np.array([peak_of(np.delete(largest, k, axis=1)).max() for k in range(count)])
    return float(np.sqrt((count - 1) * left.var()))


def finished(runs: np.ndarray) -> np.ndarray:
    """Return the outcomes of `ensemble`, if all runs finished.

    Raises
    ------
    ArithmeticError
        If a run could not be finished.
    """
    failed = runs["status"][runs["status"] != FINISHED]
    if len(failed):
        raise ArithmeticError(f"a peak cannot be measured: {STATUSES[int(failed[0])]}")
    return runs
