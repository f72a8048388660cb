"""Define what each integrator provides: a name, settings from coarse to fine, and runs that report their failures."""

from abc import ABC, abstractmethod
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from functools import cached_property

import numpy as np

IMPACT = np.dtype([("tau", "f8"), ("module", "i1"), ("wall", "i1"), ("speed", "f8")])
"""Data type of an impact: time, module 1 or 2, wall +1 or -1, speed |W'| just before."""

FINISHED, REFUSED, UNFINISHED = "finished", "refused", "unfinished"
"""Outcomes of a run: it has a result; the method refused the system or failed; the method ran out of steps or stalled
in an endless chatter."""


@dataclass(eq=False)
class MethodRun:
    """Result of a run of one method.

    final: state at the end, [X1, Y1, X2, Y2, X1', Y1', X2', Y2'], shape (8,), or None after a failure.
    noted: impacts (tau, module, wall, speed) in order of time, or a function that returns these impacts.
    steps: number of integration steps.
    evaluations: number of evaluations of the right-hand side, or 0 if the method does not count them.
    outcome: FINISHED, REFUSED or UNFINISHED.
    reason: text on why the run has no result, or "".
    doubt: function that returns a text on what the method could not decide, or "".

    The functions `noted` and `doubt` are called after the run, so the measured run time does not include them.
    """

    final: np.ndarray | None
    noted: Iterable | Callable[[], Iterable]
    steps: int
    evaluations: int = 0
    outcome: str = FINISHED
    reason: str = ""
    doubt: Callable[[], str] = lambda: ""

    @cached_property
    def impacts(self) -> np.ndarray:
        """Impacts in `noted` as an array of the data type IMPACT, shape (n,)."""
        rows = self.noted() if callable(self.noted) else self.noted
        return np.array([tuple(row) for row in rows], IMPACT)


class Method(ABC):
    """An integrator of (10.2).

    To add an integrator, write a subclass and list an instance of it in `integrators.METHODS`.

    name, family: texts for tables and legends.
    knob: meaning of the setting, such as "steps per cycle".
    settings: values of the setting from coarse to fine.
    careful: setting that a careful user would choose for difficult motions.
    limit: largest number of steps of a run. A run with this number of steps takes roughly half a minute.
    order: expected order of convergence of the error as the quantity `scale` tends to 0, or None.
    compiles_settings: True if each setting has its own compiled code.
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
        """Return None, or the reason why the method cannot run on this machine."""
        return None

    @abstractmethod
    def run(self, system, state, cycles: int, tau0: float, setting) -> MethodRun:
        """Integrate from a state (8,) at tau0 over `cycles` forcing periods in at most `self.limit` steps.

        setting: one of `settings`. If the run cannot continue, return the result of `failed`.
        """

    def scale(self, setting, run: MethodRun) -> float:
        """Return the small quantity that controls the error; by default 1 / number of steps."""
        return 1.0 / run.steps


def failed(outcome: str, reason: str, steps: int, evaluations: int = 0, noted=()) -> MethodRun:
    """Return the MethodRun of a failed run; its final state is None, and `noted` are the impacts before the failure."""
    return MethodRun(None, noted, steps, evaluations, outcome, reason)
