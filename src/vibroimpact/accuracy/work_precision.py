"""Measure work-precision data: error and cost of each method at each of its settings."""

from dataclasses import dataclass
from functools import partial

import numpy as np

from vibroimpact.accuracy.errors import run_errors
from vibroimpact.accuracy.reference.run import proven_run
from vibroimpact.accuracy.timing import interleaved
from vibroimpact.integrators.protocol import FINISHED, Method
from vibroimpact.system import System

RESOLVED = 0.03, 1e-11
"""Largest and smallest error from which the order of a method is fitted. Larger errors are distances between two
different motions; smaller errors are due to rounding."""


@dataclass(frozen=True)
class Problem:
    """Motion to compute, over `cycles` forcing cycles from the initial state `state`, shape (8,), at tau = 0."""

    name: str
    system: System
    state: tuple[float, ...]
    cycles: int


def measure(problem: Problem, methods: list[Method], seconds: float, short: bool = False) -> list[dict]:
    """Return one row per method and setting: errors, time per cycle [s] and fitted order.

    seconds: time [s] for which the run with each setting is repeated. short: True to skip every second setting.
    """
    reference = proven_run(problem.system, problem.state, problem.cycles, exact_floats=False).run
    settings = [
        (method, setting)
        for method in methods
        if not method.available()
        for setting in (method.settings[::-2][::-1] if short else method.settings)
    ]
    works = [partial(m.run, problem.system, problem.state, problem.cycles, 0.0, setting) for m, setting in settings]
    for n, (method, _) in enumerate(settings):
        if method.compiles_settings or n == 0 or settings[n - 1][0] is not method:
            works[n]()
    timed = list(zip(settings, interleaved(works, seconds), strict=True))
    rows = []
    for method in methods:
        row = {"problem": problem.name, "method": method.name, "family": method.family}
        if reason := method.available():
            rows.append(row | {"setting": "", "outcome": "unavailable", "reason": reason})
            continue
        runs = [(setting, run, time) for (one, setting), (run, time) in timed if one is method]
        measured = [row | _measured(problem, *one, reference) for one in runs]
        # The order is fitted to the finished runs without missed or spurious impacts.
        points = [
            (method.scale(setting, run), found["error_state"])
            for (setting, run, _), found in zip(runs, measured, strict=True)
            if run.outcome == FINISHED and found["missed"] == found["spurious"] == 0
        ]
        order = fitted_order(points) if method.order else None
        rows += [found | {"order": order} for found in measured]
    return rows


def _measured(problem, setting, run, time, reference):
    """Return the columns of a run.

    The column `reason` contains the cause of a failure, or the doubt that the method reports about its own result.
    """
    return {
        "setting": str(setting),
        **run_errors(run, reference, problem.system.period)._asdict(),
        "seconds_per_cycle": time / problem.cycles,
        "steps": run.steps,
        "evaluations": run.evaluations,
        "outcome": run.outcome,
        "reason": run.reason or run.doubt(),
    }


def fitted_order(points) -> float | None:
    """Return the slope of log(error) against log(scale), or None if fewer than three errors can be used.

    points: pairs (scale, error). Only errors in the range RESOLVED are used.
    """
    largest, smallest = RESOLVED
    resolved = [(scale, error) for scale, error in points if smallest <= error <= largest]
    if len(resolved) < 3:
        return None
    scale, error = np.log(np.array(resolved)).T
    return float(np.polyfit(scale, error, 1)[0])
