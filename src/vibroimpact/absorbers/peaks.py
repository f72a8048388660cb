"""The highest displacement with balls over a band of frequencies, as several starts find it, and its spread.

A chaotic response is seen for a limited time, at some frequencies and from some starts: the highest displacement of
these is too low, never too high. The lowest of many such peaks is lower still, since it is chosen where chance was
kind. So a lowest peak is measured again, from other starts, once its place is chosen.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from vibroimpact.exact.engine.ensemble import STATUSES, ensemble
from vibroimpact.exact.engine.event_loop import FINISHED
from vibroimpact.system import System
from vibroimpact.system.arguments import reals


@dataclass(frozen=True)
class Peak:
    """The largest |X_i| of both boxes over a band of frequencies.

    value: the largest of all starts, dimensionless. spread: see `spread_of_largest`. at: number of the system, along
    the band, where it is met. starts: (n,), the largest over the band of each start.
    """

    value: float
    spread: float
    at: int
    starts: np.ndarray


def peak(systems: Sequence[System], states: ArrayLike, cycles: int, settle: int) -> Peak:
    """The peak of systems along a band, each from all states (n, 8).

    Args:
        cycles, settle: of `ensemble`; a run is observed after `settle` cycles.

    Raises:
        ArithmeticError: a run could not be finished.
        ValueError: as `ensemble`.
    """
    runs = ensemble(np.array(systems, dtype=object)[:, None], states, cycles, settle=settle)
    failed = runs["status"][runs["status"] != FINISHED]
    if len(failed):
        raise ArithmeticError(f"a peak cannot be measured: {STATUSES[int(failed[0])]}")
    largest = runs["largest"].max(axis=2)
    starts = largest.max(axis=0)
    return Peak(float(starts.max()), spread_of_largest(starts), int(largest.max(axis=1).argmax()), starts)


def spread_of_largest(values: ArrayLike) -> float:
    """Standard deviation of the largest of n values, if n are drawn from them again (bootstrap); nan for fewer than 2.

    Drawn with replacement, the largest is at most the k-th smallest with probability (k / n)^n, so that no drawing is
    needed. It tells how much the largest depends on single values. It is no bound: values that were never met may be
    larger than all of these.

    >>> round(spread_of_largest([1.0, 2.0]), 4)  # 1 in one of four drawings, else 2
    0.433

    Raises:
        ValueError: a value is not finite.
    """
    ordered = np.sort(reals("values", values), axis=None)
    if not np.isfinite(ordered).all():
        raise ValueError(f"values: needs finite numbers, got {values}")
    number = len(ordered)
    if number < 2:
        return float("nan")
    likelihood = np.diff((np.arange(number + 1) / number) ** number)
    above = ordered - ordered[-1]  # from the largest, so that equal values have no spread
    return float(np.sqrt(max(likelihood @ above**2 - (likelihood @ above) ** 2, 0.0)))
