"""Measure work-precision data: error and cost of each method at each of its settings."""

from dataclasses import dataclass
from functools import partial

import numpy as np

from vibroimpact.accuracy.errors import run_errors
from vibroimpact.accuracy.reference.run import proven_run
from vibroimpact.accuracy.timing import interleaved
from vibroimpact.integrators.protocol import Method, MethodRun
from vibroimpact.system import System

RESOLVED = 0.03, 1e-11
"""Largest and smallest error used to fit an order. Larger errors are distances between two different motions; smaller
errors are due to rounding."""


@dataclass(frozen=True)
class Problem:
    """Motion to compute: name, system, initial state (8,) at tau = 0, and number of forcing cycles."""

    name: str
    system: System
    state: tuple[float, ...]
    cycles: int


def measure(problem: Problem, methods: list[Method], seconds: float, short: bool = False) -> list[dict]:
    """Return one row per method and setting: errors against the reference, time per cycle [s] and fitted order.

    Parameters
    ----------
    seconds : float
        Time [s] for which each setting is repeated, in turn with the others, after a first call that compiles.
    short : bool, default False
        Use only every second setting of each method.
    """
    reference = proven_run(problem.system, problem.state, problem.cycles, exact_floats=False).run
    missing = [method for method in methods if method.available()]
    settings = [
        (method, setting)
        for method in methods
        if method not in missing
        for setting in (method.settings[::-2][::-1] if short else method.settings)
    ]
    for n, (method, setting) in enumerate(settings):
        if method.compiles_settings or n == 0 or settings[n - 1][0] is not method:
            _run(problem, method, setting)
    timed = interleaved([partial(_run, problem, method, setting) for method, setting in settings], seconds)
    rows = [
        _row(problem, method, setting, **_measured(problem, run, time, reference))
        for (method, setting), (run, time) in zip(settings, timed, strict=True)
    ]
    orders = {method.name: _order(method, settings, timed, rows) for method in methods if method.order}
    rows = [{**row, "order": orders.get(row["method"])} for row in rows]
    unavailable = [_row(problem, method, None, outcome="unavailable", reason=method.available()) for method in missing]
    places = {method.name: n for n, method in enumerate(methods)}
    return sorted(rows + unavailable, key=lambda row: places[row["method"]])


def _measured(problem, run, time, reference):
    """Return the columns of a run: errors, time, steps, evaluations, outcome, and the reason for a failure or doubt."""
    return {
        **run_errors(run, reference, problem.system.period).columns(),
        "seconds_per_cycle": time / problem.cycles,
        "steps": run.steps,
        "evaluations": run.evaluations,
        "outcome": run.failure.kind if run.failure else "finished",
        "reason": run.failure.reason if run.failure else (run.doubt() or ""),
    }


def _order(method, settings, timed, rows):
    """Return the order of convergence of a method, fitted to its runs without missed or spurious impacts."""
    points = [
        (method.scale(setting, run), row["error_state"])
        for (one, setting), (run, _), row in zip(settings, timed, rows, strict=True)
        if one is method and run.failure is None and row["missed"] == row["spurious"] == 0
    ]
    return fitted_order(points)


def _run(problem, method, setting) -> MethodRun:
    return method.run(problem.system, problem.state, problem.cycles, 0.0, setting)


def _row(problem, method, setting, **measured):
    text = "" if setting is None else str(setting)
    return {"problem": problem.name, "method": method.name, "family": method.family, "setting": text, **measured}


def fitted_order(points) -> float | None:
    """Fit log(error) against log(scale) by least squares; return the slope, or None for fewer than three points.

    Only the points (scale, error) whose error is in the range RESOLVED are used.
    """
    largest, smallest = RESOLVED
    resolved = [(scale, error) for scale, error in points if smallest <= error <= largest]
    if len(resolved) < 3:
        return None
    scale, error = np.log(np.array(resolved)).T
    return float(np.polyfit(scale, error, 1)[0])
