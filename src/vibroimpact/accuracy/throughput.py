"""Measure the time per impact of ensembles, single runs and heyoka's batches in typical uses (see `Scene`).

All methods are timed in turn. For ensembles, the error and the share of runs with as many impacts as the corresponding
single run are measured as well.
"""

from functools import partial
from typing import NamedTuple

import numpy as np

from vibroimpact.accuracy.timing import interleaved
from vibroimpact.exact.engine.all_cores import at_most
from vibroimpact.exact.engine.simulation import simulate
from vibroimpact.exact.lanes.ensemble import ensemble
from vibroimpact.integrators.heyoka_batch import LANES, HeyokaBatch
from vibroimpact.integrators.heyoka_taylor import heyoka
from vibroimpact.system import System
from vibroimpact.system.state import BALLS, BOXES, IMPACT

LONG = 4000
"""Number of forcing cycles of the single long run. The time per impact of ensembles is divided by that of this run."""
SAMPLE, SHORT = 8, 10
"""Number of single runs that are timed per scene, and number of their cycles. Errors are also measured after SHORT
cycles."""
CHECKED = 64
"""Number of runs of a scene whose events and final states are compared with single runs."""
TOLERANCES = 1e-6, 1e-12
"""Tolerances of heyoka."""


class Scene(NamedTuple):
    """Arguments of `ensemble`: systems, initial states and number of cycles."""

    systems: System | np.ndarray
    states: np.ndarray
    cycles: int

    def runs(self, count):
        """Return the systems and initial states of `count` runs that are evenly spread over the scene."""
        systems = np.asarray(self.systems, dtype=object)
        shape = np.broadcast_shapes(systems.shape, self.states.shape[:-1])
        places = np.unique(np.linspace(0, np.prod(shape) - 1, count).astype(int))
        states = np.broadcast_to(self.states, (*shape, 8)).reshape(-1, 8)
        return np.broadcast_to(systems, shape).flat[places], states[places]


def scenes(equal: System, weak: System, settled) -> dict[str, Scene]:
    """Return the scenes, keyed by their descriptions.

    settled: state (8,) of a motion of `equal` without sticking.
    """
    sweep = [
        [equal.with_(sigma_e_hat=detuning, f10_hat=force, f20_hat=force)]
        for detuning in np.linspace(-0.5, 1.0, 20)
        for force in np.linspace(0.5, 1.5, 15)
    ]
    near, wide = _around(settled, 64, 1e-2), _around(settled, 256, 0.3)
    return {
        "64 starts within 1e-2 of a settled motion, 100 cycles": Scene(equal, near, 100),
        "16 such starts": Scene(equal, near[:16], 100),
        "256 starts within 0.3, 100 cycles": Scene(equal, wide, 100),
        "4000 random starts, 10 cycles": Scene(equal, _random(4000), 10),
        "400 random starts, 100 cycles": Scene(equal, _random(400), 100),
        "weak case, 200 random starts, 500 cycles": Scene(weak, _random(200), 500),
        "300 systems x 2 starts, 250 cycles": Scene(np.array(sweep), _random(2), 250),
        "300 systems x 5 starts, 250 cycles": Scene(np.array(sweep), _random(5), 250),
    }


def _random(count):
    states = np.random.default_rng(0).uniform(-0.5, 0.5, (count, 8))
    states[:, BALLS[:2]] += states[:, BOXES[:2]]
    return states


def _around(state, count, distance):
    states = np.asarray(state, dtype=float) + np.random.default_rng(1).uniform(-distance, distance, (count, 8))
    boxes = states[:, BOXES[:2]]
    states[:, BALLS[:2]] = np.clip(states[:, BALLS[:2]], boxes - 0.99, boxes + 0.99)
    return states


def throughput(equal: System, weak: System, settled, seconds: float) -> list[dict]:
    """Return one row per scene: time per impact [ns] of each method, ratios of two of these times, and errors.

    A ratio is the time per impact of `ensemble`, in one of its two uses, divided by that of a single long run.

    In each scene, all methods and the single long run are timed in turn on one core.

    Parameters
    ----------
    settled
        State (8,) of a motion of `equal` without sticking.
    seconds : float
        Time [s] for which each method is repeated.
    """
    long_run = partial(simulate, equal, settled, LONG)
    with at_most(1):
        return [
            {"scene": name} | _timed(scene, long_run, seconds) | _compared(scene)
            for name, scene in scenes(equal, weak, settled).items()
        ]


def ranges(rows: list[dict]) -> list[str]:
    """Return lines of text with the ranges, over all scenes, of the ratios in `rows`, the result of `throughput`.

    A ratio is the time per impact of `ensemble` divided by that of a single long run.
    """
    found = {name: [row[f"{name} / long run"] for row in rows] for name in ("final", "observed")}
    return [
        f"{name}: {min(ratios):.2f} to {max(ratios):.2f} of a long run's time per impact in all scenes"
        for name, ratios in found.items()
    ]


def _timed(scene, long_run, seconds):
    """Return the time per impact [ns] of every method in a scene.

    For both uses of `ensemble`, the ratio of this time to that of `long_run` is also returned.
    """
    impacts, systems, states = _impacts(scene), *scene.runs(SAMPLE)
    few = _impacts(Scene(systems, states, SHORT))
    pairs = list(zip(systems, states, strict=True))
    functions = {
        "one long run": (long_run, len(long_run().rows)),
        "final": (partial(ensemble, *scene, settle=scene.cycles), impacts),
        "observed": (partial(ensemble, *scene), impacts),
        "one by one": (lambda: [simulate(system, state, SHORT) for system, state in pairs], few),
    }
    flying = [one for one in zip(*scene.runs(8 * LANES), strict=True) if not ensemble(*one, SHORT)["sticks"].any()]
    if heyoka and len(flying) >= LANES:
        systems, states = (np.array(part) for part in zip(*flying[:LANES], strict=True))
        count = _impacts(Scene(systems, states, SHORT))
        for tolerance in TOLERANCES:
            batch = HeyokaBatch(tolerance)
            functions[f"heyoka {tolerance:g}"] = partial(batch.run, systems, states.T, SHORT), count
    for work, _ in functions.values():
        work()
    times = interleaved([work for work, _ in functions.values()], seconds)
    found = {name: 1e9 * time / count for (name, (_, count)), (_, time) in zip(functions.items(), times, strict=True)}
    unit = found["one long run"]
    return found | {"final / long run": found["final"] / unit, "observed / long run": found["observed"] / unit}


def _impacts(scene):
    return int(ensemble(*scene)["impacts"].sum())


def _compared(scene):
    """Compare an ensemble with single runs: share of runs with equal impact counts, median error of the final state."""
    systems, states = scene.runs(CHECKED)
    outcomes = ensemble(systems, states, SHORT)
    singles = [simulate(system, state, SHORT) for system, state in zip(systems, states, strict=True)]
    counts = np.array([(run.events["kind"] == IMPACT).sum() for run in singles])
    finals = np.array([run.final for run in singles])
    return {
        "same events": np.mean(outcomes["impacts"].sum(axis=1) == counts),
        "error": np.median(abs(outcomes["final"] - finals).max(axis=1)),
    }
