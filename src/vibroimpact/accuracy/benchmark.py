"""Compare the time per impact of every method on the same motion, as ratios, with its error."""

from fractions import Fraction
from string import ascii_lowercase

import numpy as np

from vibroimpact.accuracy.reference.run import reference_run
from vibroimpact.accuracy.work_precision import Problem
from vibroimpact.accuracy.work_precision import measure as work_precision

DIGITS = 40
OURS, CERTIFIED, MODAL, TAYLOR = "this engine", "this engine, certified", "modal scan", "heyoka"
RUNGE_KUTTA, SCIPY = "RK4, compiled", "DOP853"
GENERAL_PURPOSE_ERROR = 1e-6
"""Error at which general-purpose methods are compared."""
ACCURATE, USEFUL = 1e-6, 1e-3
"""Errors at which heyoka is compared in every panel."""
SHOWN = "method", "setting", "us_per_impact", "error_state", "error_time", "missed", "spurious", "reason"


def measure(problem: Problem, methods, seconds: float) -> list[dict]:
    """Return one row per method and setting for one motion on one core.

    Columns include the time per impact [us], its ratio to this engine, and errors.

    Parameters
    ----------
    seconds : float
        Time over which each setting is repeated, as in `work_precision.measure`.
    """
    impacts = len(reference_run(problem.system, problem.state, problem.cycles, DIGITS, exact_floats=False).events)
    rows = [row for row in work_precision(problem, methods, seconds) if row["outcome"] != "unavailable"]
    rows = [{**row, "us_per_impact": 1e6 * row["seconds_per_cycle"] * problem.cycles / impacts} for row in rows]
    ours = min(row["us_per_impact"] for row in rows if row["method"] == OURS)
    return [{**{name: row[name] for name in SHOWN}, "ratio": row["us_per_impact"] / ours} for row in rows]


def unavoidable_error(problem: Problem, digits: int = DIGITS) -> float:
    """Return the error caused by rounding the state to float64 once per forcing cycle, all else being exact.

    It is the largest difference of a coordinate, at any whole cycle, between the motion and the motion with rounded
    states. No method with float64 states can avoid it; it includes the conditioning of the motion.
    """
    exact = rounded = [Fraction(repr(float(value))) for value in problem.state]
    largest = Fraction(0)
    for _ in range(problem.cycles):
        exact = _after_one_cycle(problem.system, exact, digits)
        rounded = [Fraction(float(value)) for value in _after_one_cycle(problem.system, rounded, digits)]
        largest = max(largest, *(abs(a - b) for a, b in zip(exact, rounded, strict=True)))
    return float(largest)


def _after_one_cycle(system, state, digits):
    """Return the state (8,) one forcing period later, as rational numbers accurate to `digits`."""
    return [Fraction(text) for text in reference_run(system, state, 1, digits, exact_floats=False).final_text]


def comparison(rows: list[dict], unavoidable: float) -> dict[str, float]:
    """Return a summary of the rows of `measure`, by name; missing integrators are omitted."""
    ours = _fastest(rows, OURS, np.inf)
    times = {
        "with its certificate": _fastest(rows, CERTIFIED, np.inf),
        "modal closed form, scan and Newton": _fastest(rows, MODAL, GENERAL_PURPOSE_ERROR),
        f"RK4 and Newton, compiled, at {GENERAL_PURPOSE_ERROR:g}": _fastest(rows, RUNGE_KUTTA, GENERAL_PURPOSE_ERROR),
        f"heyoka at {GENERAL_PURPOSE_ERROR:g}": _fastest(rows, TAYLOR, GENERAL_PURPOSE_ERROR),
        "heyoka at its most accurate": min(_of(rows, TAYLOR), key=lambda row: row["error_state"], default=None),
        f"SciPy's DOP853 at {GENERAL_PURPOSE_ERROR:g}, in Python": _fastest(rows, SCIPY, GENERAL_PURPOSE_ERROR),
    }
    return {
        "us per impact": ours["us_per_impact"],
        **{f"times this engine alone, {method}": row["ratio"] for method, row in times.items() if row},
        f"error over the unavoidable {unavoidable:.2g}": ours["error_state"] / unavoidable,
    }


def panels(rows: list[dict]) -> list[dict]:
    """Return the ratio of heyoka's time to this engine's time in every panel of the chart.

    The rows are those of `work_precision.measure`. heyoka runs at the coarsest tolerance whose error of the final state
    is at most ACCURATE, and at its fastest one with an error below USEFUL. Without such a run the ratio is nan, and
    "reason" explains it.
    """
    problems = dict.fromkeys(row["problem"] for row in rows)
    return [
        {"panel": letter, "problem": problem} | _against_taylor([row for row in rows if row["problem"] == problem])
        for letter, problem in zip(ascii_lowercase, problems, strict=False)
    ]


def _against_taylor(rows):
    """Return the ratios of one panel and their tolerances."""
    (ours,) = (row for row in rows if row["method"] == OURS)
    others = [row for row in rows if row["method"] == TAYLOR]
    finished = [row for row in others if row["outcome"] == "finished"]
    useful = [row for row in finished if row["error_state"] < USEFUL]
    met = {
        f"at {ACCURATE:g}": next((row for row in finished if row["error_state"] <= ACCURATE), None),
        "at its fastest": min(useful, key=lambda row: row["seconds_per_cycle"], default=None),
    }
    found = {"us per cycle": 1e6 * ours["seconds_per_cycle"]}
    for name, row in met.items():
        found[name] = row["seconds_per_cycle"] / ours["seconds_per_cycle"] if row else np.nan
        found[f"tolerance {name}"] = row["setting"] if row else ""
    missing = next((row["reason"] for row in others if row["outcome"] == "unavailable"), "no such run")
    return found | {"reason": "" if all(met.values()) else f"heyoka: {missing}"}


def _of(rows, method):
    return [row for row in rows if row["method"] == method and not row["reason"]]


def _fastest(rows, method, accuracy):
    """Return the fastest row of a method with at most this error, or None."""
    good = [row for row in _of(rows, method) if row["error_state"] <= accuracy]
    return min(good, key=lambda row: row["us_per_impact"], default=None)
