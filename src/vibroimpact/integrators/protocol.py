"""Protocol of an integrator: a name, settings from coarse to fine, and runs that report their failures."""

from abc import ABC, abstractmethod
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from functools import cached_property

import numpy as np

IMPACT = np.dtype([("tau", "f8"), ("module", "i1"), ("wall", "i1"), ("speed", "f8")])
"""One impact as a method reports it: time, module 1 or 2, wall +1 or -1, speed |W'| just before."""

REFUSED, UNFINISHED = "refused", "unfinished"


@dataclass(frozen=True)
class Failure:
    """Reason why a run has no result. kind: REFUSED (the method raised or returned an error) or UNFINISHED (out of
    steps).
    """

    kind: str
    reason: str


@dataclass(eq=False)
class MethodRun:
    """The result of a method.

    final: (8,) state at the end, [X1, Y1, X2, Y2, X1', Y1', X2', Y2'], or None after a failure; noted: the impacts in
    the order of time, (tau, module, wall, speed) each, or a function that gives them; steps: integration steps taken;
    evaluations: evaluations of the right-hand side, where the method counts them, else 0; failure: None, or why there
    is no result; doubt(): None, or what the method itself says that it cannot decide about the result it gives.

    `impacts` and doubt() are evaluated after the run, so that its time does not include them.
    """

    final: np.ndarray | None
    noted: Iterable | Callable[[], Iterable]
    steps: int
    evaluations: int = 0
    failure: Failure | None = None
    doubt: Callable[[], str | None] = lambda: None

    @cached_property
    def impacts(self) -> np.ndarray:
        """The noted impacts as one table, (n,) IMPACT."""
        rows = self.noted() if callable(self.noted) else self.noted
        return np.array([tuple(row) for row in rows], IMPACT)


class Method(ABC):
    """One integrator of (10.2). A new one is one file with a subclass, listed in `integrators.METHODS`.

    name, family: as printed; settings: from coarse to fine, all of one kind (`knob` says which); careful: the
    one that a careful user would choose where methods fail; order: the order of convergence in `scale` that theory
    expects, or None; limit: steps after which a run is given up, what can be done in roughly half a minute;
    compiles_settings: whether each setting has code of its own, compiled when it is first run.
    """

    name: str
    family: str
    knob: str
    settings: tuple
    careful: float | int | str
    limit: int = 100_000
    order: float | None = None
    compiles_settings: bool = False

    def available(self) -> str | None:
        """Return None, or why the method cannot run on this machine."""
        return None

    @abstractmethod
    def run(self, system, state, cycles: int, tau0: float, setting, limit: int | None = None) -> MethodRun:
        """Integrate from a state (8,) at tau0 over so many forcing periods in at most `limit` steps.

        setting: one of `settings`. limit: by default the method's. A run that cannot go on comes back with a failure.
        """

    def scale(self, setting, run: MethodRun) -> float:
        """Return the small quantity in which the error is expected to fall: by default the mean step."""
        return 1.0 / run.steps


def failed(kind: str, reason: str, steps: int, evaluations: int = 0, noted=()) -> MethodRun:
    """Return a run without a result; the impacts found until then are kept."""
    return MethodRun(None, noted, steps, evaluations, Failure(kind, reason))
