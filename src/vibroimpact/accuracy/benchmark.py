"""Compare all methods on the same motion: time per impact, its ratio to that of the package's engine, errors."""

from fractions import Fraction

from vibroimpact.accuracy.reference.run import reference_run
from vibroimpact.accuracy.work_precision import Problem
from vibroimpact.accuracy.work_precision import measure as work_precision

DIGITS = 40
OURS = "this engine"
COLUMNS = "method", "setting", "us_per_impact", "error_state", "error_time", "missed", "spurious", "reason"


def measure(problem: Problem, methods, seconds: float) -> list[dict]:
    """Measure every setting of each method on one motion, and return one row per setting.

    Columns: those of COLUMNS, and ratio, the time per impact relative to the fastest setting of the package's engine.

    Parameters
    ----------
    seconds : float
        Time [s] for which the run with each setting is repeated, as in `work_precision.measure`.
    """
    impacts = len(reference_run(problem.system, problem.state, problem.cycles, DIGITS, exact_floats=False).events)
    rows = [row for row in work_precision(problem, methods, seconds) if row["outcome"] != "unavailable"]
    rows = [{**row, "us_per_impact": 1e6 * row["seconds_per_cycle"] * problem.cycles / impacts} for row in rows]
    ours = min(row["us_per_impact"] for row in rows if row["method"] == OURS)
    return [{**{name: row[name] for name in COLUMNS}, "ratio": row["us_per_impact"] / ours} for row in rows]


def unavoidable_error(problem: Problem) -> float:
    """Return the error of an otherwise exact run whose state is rounded to float64 once per forcing cycle.

    The error is the largest difference of a coordinate from the exact motion, over the ends of all cycles. No method
    with float64 states can avoid this error. It is large where the motion is sensitive to its initial state.
    """
    exact = rounded = [Fraction(repr(float(value))) for value in problem.state]
    largest = Fraction(0)
    for _ in range(problem.cycles):
        exact = _after_one_cycle(problem.system, exact)
        rounded = [Fraction(float(value)) for value in _after_one_cycle(problem.system, rounded)]
        largest = max(largest, *(abs(a - b) for a, b in zip(exact, rounded, strict=True)))
    return float(largest)


def _after_one_cycle(system, state):
    """Return the state (8,) one forcing period after `state`, as rational numbers accurate to DIGITS decimals."""
    final = reference_run(system, state, 1, DIGITS, exact_floats=False).final_exact
    return [Fraction(value.str(DIGITS, radius=False)) for value in final]
