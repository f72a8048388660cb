"""Speed of very many runs: ensembles beside single runs and beside heyoka's batches, and on all cores."""

from functools import partial

import numpy as np

from vibroimpact.accuracy.timing import interleaved
from vibroimpact.exact.engine.all_cores import at_most, cores
from vibroimpact.exact.engine.ensemble import ensemble
from vibroimpact.exact.engine.simulation import simulate
from vibroimpact.integrators.heyoka_batch import LANES, HeyokaBatch
from vibroimpact.integrators.heyoka_taylor import heyoka
from vibroimpact.system import System
from vibroimpact.system.state import BALLS, BOXES

NEAR, CYCLES = 1e-4, 100
"""Starts of the settled motion are that near to each other; they are run for so many cycles."""
RANDOM, SHORT = 20_000, 10
"""Random starts, and their cycles."""
TOLERANCES = 1e-6, 1e-12


def throughput(system: System, settled, seconds: float) -> list[dict]:
    """Rows of what is run, "ns per impact", and "ratio" to single runs of the settled motion; all timed in turn.

    Args:
        settled: state (8,) of a motion without sticking, from which LANES^2 starts are run.
        seconds: how long each is repeated.
    """
    near = np.asarray(settled, dtype=float) + np.linspace(0.0, NEAR, LANES**2)[:, np.newaxis]
    spread = np.random.default_rng(0).uniform(-0.5, 0.5, (RANDOM, 8))
    spread[:, BALLS[:2]] += spread[:, BOXES[:2]]
    random = partial(ensemble, system, spread, SHORT)
    one_core = {
        "simulate, one start after another": lambda: [simulate(system, start, CYCLES) and None for start in near],
        "ensemble": partial(ensemble, system, near, CYCLES, settle=CYCLES),
        "ensemble, observed": partial(ensemble, system, near, CYCLES),
        f"ensemble, {RANDOM:,} random starts over {SHORT} cycles": partial(random, settle=SHORT),
        "ensemble, random starts, observed": random,
    }
    if heyoka:
        for tolerance in TOLERANCES:
            batch = HeyokaBatch(system, tolerance)
            one_core[f"heyoka, batches of {LANES} at {tolerance:g}"] = partial(_in_batches, batch, near)
    all_cores = {f"ensemble, random starts on {cores()} core(s), wall time": partial(random, settle=SHORT)}
    impacts = {len(near): _impacts(system, near, CYCLES), len(spread): _impacts(system, spread, SHORT)}
    with at_most(1):
        found = _timed(one_core, seconds)
    found |= _timed(all_cores, seconds)
    rows = []
    for name, time in found.items():
        count = impacts[len(spread) if "random" in name else len(near)]
        rows.append({"run": name, "ns per impact": 1e9 * time / count})
    return [row | {"ratio": row["ns per impact"] / rows[0]["ns per impact"]} for row in rows]


def _timed(works, seconds):
    """Seconds of the fastest call of each, after a first one."""
    for work in works.values():
        work()
    return dict(zip(works, (time for _, time in interleaved(list(works.values()), seconds)), strict=True))


def _in_batches(batch, starts):
    for first in range(0, len(starts), LANES):
        batch.run(starts[first : first + LANES].T, CYCLES)


def _impacts(system, states, cycles):
    return int(ensemble(system, states, cycles)["impacts"].sum())
