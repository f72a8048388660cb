"""Mean lifetime of a chaotic transient that ends in a periodic motion: a censored estimate."""

from dataclasses import dataclass

import numpy as np

from vibroimpact.exact.engine.ensemble import finals
from vibroimpact.regimes.classification import UNSETTLED, observe

UNSEEN = 0.05
"""A lifetime below the lower bound would have shown an escape but with this probability."""


@dataclass(frozen=True)
class Lifetime:
    """Escapes among so many trials, each a start followed over `step` cycles that had not escaped before."""

    escapes: int
    trials: int
    step: int

    @property
    def total(self) -> int:
        """Cycles that were watched."""
        return self.trials * self.step

    @property
    def mean(self) -> float:
        """Mean lifetime in cycles, the most likely one for exponential lifetimes seen every `step` cycles.

        For lives much longer than a step it is total time over escapes. inf if none ended; nan if all ended within
        their first step, which is too long to tell.
        """
        if self.escapes == 0:
            return np.inf
        return np.nan if self.escapes == self.trials else -self.step / np.log1p(-self.escapes / self.trials)

    @property
    def error(self) -> float:
        """Standard error of the mean lifetime, nan where none, or all, ended."""
        if self.escapes in (0, self.trials):
            return np.nan
        part = self.escapes / self.trials
        return self.mean**2 / self.step * np.sqrt(part / (1 - part) / self.trials)

    @property
    def least(self) -> float:
        """Lower bound of the mean lifetime where none ended, nan elsewhere."""
        return np.nan if self.escapes else -self.total / np.log(UNSEEN)


def lifetime(system, states, discarded: int, step: int, longest: int, window: int, nearness: float) -> Lifetime:
    """Follow starts until a periodic motion has caught them, looked for every `step` cycles.

    Args:
        states: (n, 8) starts.
        discarded: cycles that do not count, in which starts in the basin of the periodic motion settle on it.
            Exponential lives have no memory, so the others lose nothing.
        step, longest: cycles between two looks, and after which a start is given up.
        window, nearness: as in `observe`.
    """
    escapes = trials = 0
    now = _staying(system, states, discarded, window, nearness)
    for _ in range((longest - discarded) // step):
        if not now:
            break
        stay = _staying(system, now, step, window, nearness)
        trials, escapes = trials + len(now), escapes + len(now) - len(stay)
        now = stay
    return Lifetime(escapes, trials, step)


def bracket(values, escapes) -> tuple[float, float]:
    """Between which neighbouring values the crisis lies: the last without escapes and the first with some, ascending.

    nan for a side that has no such value.
    """
    values, some = np.asarray(values, dtype=float), np.asarray(escapes) > 0
    first = int(np.argmax(some)) if some.any() else len(values)
    return (values[first - 1] if first > 0 else np.nan), (values[first] if first < len(values) else np.nan)


def _staying(system, states, step, window, nearness):
    """States after a step (k, 8) of the starts that no periodic motion has caught."""
    ends = finals(system, states, step)
    return [state for state in ends if observe(system, state, window, nearness).name == UNSETTLED]
