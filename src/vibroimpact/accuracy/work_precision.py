"""Work against precision: what each method's error is, and what it costs, over its ladder of settings."""

from dataclasses import dataclass

import numpy as np

from vibroimpact.accuracy.errors import compare
from vibroimpact.accuracy.reference.run import proven_run
from vibroimpact.accuracy.timing import timed
from vibroimpact.integrators.protocol import Method, MethodRun
from vibroimpact.system import System

RESOLVED = 0.03, 1e-11
"""Errors between which an order is fitted: above, the motion is another one; below, rounding takes part."""


@dataclass(frozen=True)
class Problem:
    """A motion to compute: state (8,) at tau = 0, number of forcing cycles."""

    name: str
    system: System
    state: tuple[float, ...]
    cycles: int


def measure(problem: Problem, methods: list[Method], seconds: float, short: bool = False) -> list[dict]:
    """One row per method and setting: errors against the reference, time per forcing cycle [s], order fitted.

    Args:
        seconds: how long each setting is repeated, after what is compiled at a first call has been compiled.
        short: every second setting of each ladder only.
    """
    reference = proven_run(problem.system, problem.state, problem.cycles).run
    rows = []
    for method in methods:
        ladder = method.ladder[::-2][::-1] if short else method.ladder
        rows += climb(problem, method, ladder, reference, seconds)
    return rows


def climb(problem: Problem, method: Method, ladder, reference, seconds: float) -> list[dict]:
    """The rows of one method, one per setting of the ladder, against the reference run of the problem."""
    missing = method.available()
    if missing:
        return [_row(problem, method, None, outcome="unavailable", reason=missing)]
    for setting in ladder if method.compiles_settings else ladder[:1]:
        _run(problem, method, setting)
    rows, points = [], []
    for setting in ladder:
        run, time = timed(lambda setting=setting: _run(problem, method, setting), seconds)
        errors = compare(run, reference, problem.system.period)
        if run.failure is None and errors.missed == errors.spurious == 0:
            points.append((method.scale(setting, run), errors.final))
        rows.append(
            _row(
                problem,
                method,
                setting,
                error_state=errors.final,
                error_time=errors.times,
                missed=errors.missed,
                spurious=errors.spurious,
                seconds_per_cycle=time / problem.cycles,
                steps=run.steps,
                evaluations=run.evaluations,
                outcome=run.failure.kind if run.failure else "finished",
                reason=run.failure.reason if run.failure else (run.doubt() or ""),
            )
        )
    order = fitted_order(points) if method.order else None
    return [{**row, "order": order} for row in rows]


def _run(problem, method, setting) -> MethodRun:
    return method.run(problem.system, problem.state, problem.cycles, 0.0, setting)


def _row(problem, method, setting, **measured):
    text = "" if setting is None else str(setting)
    return {"problem": problem.name, "method": method.name, "family": method.family, "setting": text, **measured}


def fitted_order(points) -> float | None:
    """Slope of log error over log scale, by least squares over the resolved points (scale, error); None below three."""
    largest, smallest = RESOLVED
    resolved = [(scale, error) for scale, error in points if smallest <= error <= largest]
    if len(resolved) < 3:
        return None
    scale, error = np.log(np.array(resolved)).T
    return float(np.polyfit(scale, error, 1)[0])
