"""Speed as ratios in one run: time per impact of every method on the same motion, with its error."""

from fractions import Fraction

import numpy as np

from vibroimpact.accuracy.reference.run import proven_run, reference_run
from vibroimpact.accuracy.work_precision import Problem, climb

OURS, TAYLOR, EXPLICIT = "this engine", "heyoka", "DOP853"
EXPLICIT_ACCURACY = 1e-8
SHOWN = "method", "setting", "us_per_impact", "error_state", "error_time", "missed", "spurious", "reason"


def measure(problem: Problem, methods, seconds: float) -> list[dict]:
    """One row per method and setting: time per impact [us], ratio to ours, errors, over one motion on one core.

    Args:
        seconds: how long each setting is repeated; the first call (compilation) is left out of the time.
    """
    reference = proven_run(problem.system, problem.state, problem.cycles).run
    per_impact = 1e6 * problem.cycles / len(reference.events)
    available = [method for method in methods if not method.available()]
    rows = [
        {**row, "us_per_impact": row["seconds_per_cycle"] * per_impact}
        for method in available
        for row in climb(problem, method, method.ladder, reference, seconds)
    ]
    ours = min(row["us_per_impact"] for row in rows if row["method"] == OURS)
    return [{**{name: row[name] for name in SHOWN}, "ratio": row["us_per_impact"] / ours} for row in rows]


def unavoidable_error(problem: Problem, digits: int = 40) -> float:
    """Error that rounding the state to float64 once per forcing cycle causes, all else being exact.

    The largest difference of a coordinate, at any whole cycle, between the motion and the one whose state is rounded
    there: what no method can avoid whose states are float64 numbers, the conditioning of the motion included.
    """
    exact = rounded = [Fraction(repr(float(value))) for value in problem.state]
    largest = Fraction(0)
    for _ in range(problem.cycles):
        exact = _after_one_cycle(problem.system, exact, digits)
        rounded = [Fraction(float(value)) for value in _after_one_cycle(problem.system, rounded, digits)]
        largest = max(largest, *(abs(a - b) for a, b in zip(exact, rounded, strict=True)))
    return float(largest)


def _after_one_cycle(system, state, digits):
    """The state (8,) a forcing period later, as rational numbers good to the digits."""
    return [Fraction(text) for text in reference_run(system, state, 1, digits).final_text]


def comparison(rows: list[dict], unavoidable: float) -> dict[str, float]:
    """The rows of `measure` in a few numbers, by name; those of rivals that are not there are left out."""
    ours = _fastest(rows, OURS, np.inf)
    taylor = min(_of(rows, TAYLOR), key=lambda row: row["error_state"], default=None)
    explicit = _fastest(rows, EXPLICIT, EXPLICIT_ACCURACY)
    times = {"heyoka at its most accurate": taylor, f"DOP853 at {EXPLICIT_ACCURACY:g}": explicit}
    return {
        "us per impact": ours["us_per_impact"],
        **{f"times faster than {rival}": row["ratio"] for rival, row in times.items() if row},
        f"error over the unavoidable {unavoidable:.2g}": ours["error_state"] / unavoidable,
    }


def _of(rows, method):
    return [row for row in rows if row["method"] == method and not row["reason"]]


def _fastest(rows, method, accuracy):
    """The fastest row of a method with at most this error, or None."""
    good = [row for row in _of(rows, method) if row["error_state"] <= accuracy]
    return min(good, key=lambda row: row["us_per_impact"], default=None)
