"""Measure the time per impact of every method for one motion, and compare ensembles with single runs."""

from functools import partial

import numpy as np

from vibroimpact.accuracy.timing import interleaved
from vibroimpact.accuracy.work_precision import Problem
from vibroimpact.accuracy.work_precision import measure as work_precision
from vibroimpact.exact.engine.all_cores import at_most
from vibroimpact.exact.engine.simulation import simulate
from vibroimpact.exact.lanes.ensemble import ensemble
from vibroimpact.integrators import TIMED
from vibroimpact.system import System
from vibroimpact.system.chapter import CASES, PARAMETERS
from vibroimpact.system.state import BALLS, BOXES, IMPACT

PROBLEM = Problem(
    "settled motion, 100 cycles",
    System(**PARAMETERS, **CASES["equal"]),
    (-0.0763, 0.3789, -0.4789, -0.7067, -0.1497, -0.6993, -0.3581, -1.2969),
    100,
)
SINGLE_RUNS = 64
"""Number of single runs per scene (see `scenes`) that are timed and compared with the ensemble."""
SHORT = 10
"""Number of cycles after which final states are compared; small, since rounding errors grow in chaotic motions."""


def methods_table(seconds: float) -> list[dict]:
    """Return one row per method and setting, with the time per impact [us] and the errors for the motion PROBLEM.

    seconds: time [s] for which the run with each setting is repeated.
    """
    run = simulate(PROBLEM.system, PROBLEM.state, PROBLEM.cycles)
    per_cycle = _impacts(run) / PROBLEM.cycles
    errors = "error_state", "error_time", "missed", "spurious", "reason"
    return [
        {"scene": PROBLEM.name, "method": row["method"], "setting": row["setting"]}
        | {"us_per_impact": 1e6 * row["seconds_per_cycle"] / per_cycle}
        | {name: row[name] for name in errors}
        for row in work_precision(PROBLEM, TIMED, seconds)
        if row["outcome"] != "unavailable"
    ]


def scenes() -> dict[str, tuple]:
    """Return scenes (sets of n motions), keyed by description.

    A scene is a tuple with these entries:

    - one system for all motions, or one system for each motion;
    - initial states, shape (n, 8);
    - number of cycles.
    """
    equal, weak = (System(**PARAMETERS, **CASES[case]) for case in ("equal", "weak"))
    sweep = [
        equal.with_(sigma_e_hat=detuning, f10_hat=force, f20_hat=force)
        for detuning in np.linspace(-0.5, 1.0, 20)
        for force in np.linspace(0.5, 1.5, 15)
    ]
    return {
        "64 starts within 0.01 of a settled motion, 100 cycles": (equal, _around(64, 1e-2), 100),
        "256 starts within 0.3 of a settled motion, 100 cycles": (equal, _around(256, 0.3), 100),
        "4000 random starts, 10 cycles": (equal, _random(4000), 10),
        "200 random starts in the weak case, 500 cycles": (weak, _random(200), 500),
        "300 systems with 5 random starts, 250 cycles": (np.repeat(sweep, 5), np.tile(_random(5), (300, 1)), 250),
    }


def scenes_table(seconds: float) -> list[dict]:
    """Return two rows per scene, with the time per impact [us] of `ensemble` and of single runs on one core.

    The row of `ensemble` also contains `error_state`. To compute it, some runs of the ensemble are repeated as single
    runs over SHORT cycles. For each of these runs, the final states of the two methods are compared, and the largest
    difference of a coordinate is taken. `error_state` is the median over the runs.

    seconds: time [s] for which the ensemble is repeated; the single runs are repeated for the same time.
    """
    with at_most(1):
        return [row for name, scene in scenes().items() for row in _compared(name, *scene, seconds)]


def _compared(name, systems, states, cycles, seconds):
    """Return the two rows of `scenes_table` for one scene (a set of motions): ensemble and single runs."""
    chosen = np.linspace(0, len(states) - 1, SINGLE_RUNS).astype(int)
    some = np.broadcast_to(np.asarray(systems, dtype=object), len(states))[chosen]
    pairs = list(zip(some, states[chosen], strict=True))
    finals = [simulate(system, state, SHORT).final for system, state in pairs]
    error = np.median(abs(ensemble(some, states[chosen], SHORT)["final"] - finals).max(axis=1))
    works = partial(ensemble, systems, states, cycles), lambda: [simulate(*pair, cycles) for pair in pairs]
    (outcomes, together), (runs, one_by_one) = interleaved(works, seconds)
    return [
        {
            "scene": name,
            "method": "ensemble",
            "us_per_impact": 1e6 * together / outcomes["impacts"].sum(),
            "error_state": error,
        },
        {"scene": name, "method": "single runs", "us_per_impact": 1e6 * one_by_one / sum(map(_impacts, runs))},
    ]


def _impacts(run) -> int:
    return int((run.events["kind"] == IMPACT).sum())


def _random(count):
    states = np.random.default_rng(0).uniform(-0.5, 0.5, (count, 8))
    states[:, BALLS[:2]] += states[:, BOXES[:2]]
    return states


def _around(count, distance):
    """Return `count` random states whose coordinates differ from those of PROBLEM.state by at most `distance`."""
    states = np.array(PROBLEM.state) + np.random.default_rng(1).uniform(-distance, distance, (count, 8))
    boxes = states[:, BOXES[:2]]
    states[:, BALLS[:2]] = np.clip(states[:, BALLS[:2]], boxes - 0.99, boxes + 0.99)
    return states
