"""Speed as ratios in one run: time per impact of every method on the same motion, with its error."""

from fractions import Fraction

import numpy as np

from vibroimpact.accuracy.errors import compare
from vibroimpact.accuracy.reference.run import proven_run, reference_run
from vibroimpact.accuracy.timing import shortest_time
from vibroimpact.accuracy.work_precision import Scene

OURS, TAYLOR, EXPLICIT = "this engine", "heyoka", "DOP853"
TIME_WANTED, TAYLOR_WANTED, EXPLICIT_WANTED = 0.5, 8.0, 1000.0
"""Microseconds per impact; times faster than heyoka at its most accurate, and than DOP853 at EXPLICIT_ACCURACY."""
EXPLICIT_ACCURACY = 1e-8
ERROR_WANTED = 10.0
"""Times the error that the conditioning of the motion makes unavoidable."""


def measure(scene: Scene, methods, seconds: float) -> list[dict]:
    """One row per method and setting: time per impact [us], ratio to ours, errors, over one motion on one core.

    Args:
        seconds: how long each setting is repeated; the first call (compilation) is left out of the time.
    """
    reference = proven_run(scene.system, scene.state, scene.cycles).run
    impacts = len(reference.events)
    rows = []
    for method in methods:
        if method.available():
            continue
        for setting in method.ladder:

            def work(method=method, setting=setting):
                return method.run(scene.system, scene.state, scene.cycles, 0.0, setting)

            run = work()
            errors = compare(run, reference, scene.system.period)
            rows.append(
                {
                    "method": method.name,
                    "setting": str(setting),
                    "us_per_impact": 1e6 * shortest_time(work, seconds) / impacts,
                    "error_state": errors.final,
                    "error_time": errors.times,
                    "missed": errors.missed,
                    "spurious": errors.spurious,
                    "reason": run.failure.reason if run.failure else "",
                }
            )
    ours = min(row["us_per_impact"] for row in rows if row["method"] == OURS)
    return [{**row, "ratio": row["us_per_impact"] / ours} for row in rows]


def unavoidable_error(scene: Scene, digits: int = 40) -> float:
    """Error that rounding the state to float64 once per forcing cycle causes, all else being exact.

    The largest difference of a coordinate, at any whole cycle of the scene, between the motion and the one whose state
    is rounded there: what no method can avoid whose states are float64 numbers, the conditioning of the motion
    included.
    """
    exact = rounded = [Fraction(repr(float(value))) for value in scene.state]
    largest = Fraction(0)
    for _ in range(scene.cycles):
        exact = _after_one_cycle(scene.system, exact, digits)
        rounded = [Fraction(float(value)) for value in _after_one_cycle(scene.system, rounded, digits)]
        largest = max(largest, *(abs(a - b) for a, b in zip(exact, rounded, strict=True)))
    return float(largest)


def _after_one_cycle(system, state, digits):
    """The state (8,) a forcing period later, as rational numbers good to the digits."""
    return [Fraction(text) for text in reference_run(system, state, 1, digits).final_text]


def judgements(rows: list[dict], unavoidable: float) -> list[dict]:
    """What was wanted and what was measured: rows (wanted, target, measured, met)."""
    ours = _fastest(rows, OURS, np.inf)
    taylor = min(_of(rows, TAYLOR), key=lambda row: row["error_state"], default=None)
    explicit = _fastest(rows, EXPLICIT, EXPLICIT_ACCURACY)
    measured = [
        ("us per impact", TIME_WANTED, ours["us_per_impact"], ours["us_per_impact"] <= TIME_WANTED),
        *_faster("times faster than heyoka at its most accurate", TAYLOR_WANTED, taylor),
        *_faster(f"times faster than DOP853 at {EXPLICIT_ACCURACY:g}", EXPLICIT_WANTED, explicit),
        (
            f"error over the unavoidable {unavoidable:.2g}",
            ERROR_WANTED,
            ours["error_state"] / unavoidable,
            ours["error_state"] <= ERROR_WANTED * unavoidable,
        ),
    ]
    return [dict(zip(("quantity", "wanted", "measured", "met"), entry, strict=True)) for entry in measured]


def _faster(what, wanted, row):
    return [(what, wanted, row["ratio"], row["ratio"] >= wanted)] if row else []


def _of(rows, method):
    return [row for row in rows if row["method"] == method and not row["reason"]]


def _fastest(rows, method, accuracy):
    """The fastest row of a method with at most this error, or None."""
    good = [row for row in _of(rows, method) if row["error_state"] <= accuracy]
    return min(good, key=lambda row: row["us_per_impact"], default=None)
