"""Speed and memory of very many runs: what an ensemble costs beside the runs themselves."""

import os
import re
from contextlib import contextmanager
from pathlib import Path

import numpy as np

from vibroimpact.accuracy.timing import shortest_time
from vibroimpact.exact.engine.all_cores import cores
from vibroimpact.exact.engine.ensemble import ensemble
from vibroimpact.exact.engine.simulation import simulate, simulate_many
from vibroimpact.system import System
from vibroimpact.system.state import BALLS, BOXES

SHORT, LONG = 10, 1000
FEW = 1000
"""Starts that are run for LONG cycles, or one by one."""
SECONDS = 2.0
"""How long a timing is repeated."""


def throughput(system: System, starts: int) -> dict[str, float]:
    """Times per impact [us] of random starts, and what they are to each other; bytes of memory per start. By name.

    What an ensemble costs beside its runs is told against `simulate` over 1000 cycles, where what Python adds to a run
    does not count; both on one core.
    """
    states = np.random.default_rng(0).uniform(-0.5, 0.5, (starts, 8))
    states[:, BALLS[:2]] += states[:, BOXES[:2]]
    few, more = states[:FEW], states[: 20 * FEW]
    ensemble(system, few, 1), ensemble(system, few, 1, settle=1), simulate_many(system, few, 1)
    before = _most_memory(anew=True)
    seconds, impacts = shortest_time(lambda: ensemble(system, states, SHORT), 0.0), _impacts(system, states, SHORT)
    kilobytes = _most_memory() - before
    all_cores = shortest_time(lambda: ensemble(system, more, SHORT), SECONDS) / len(more)
    single = shortest_time(lambda: simulate_many(system, few, SHORT), SECONDS) / len(few)
    count = cores()
    with _one_core():
        one_core = shortest_time(lambda: ensemble(system, more, SHORT), SECONDS) / len(more)
        own = shortest_time(lambda: [simulate(system, state, LONG) for state in few], SECONDS)
        plain = shortest_time(lambda: ensemble(system, few, LONG, settle=LONG), SECONDS)
        observed = shortest_time(lambda: ensemble(system, few, LONG), SECONDS)
    return {
        "us per impact of long runs": 1e6 * own / _impacts(system, few, LONG),
        "times as much in an ensemble": plain / own,
        "times as much in an ensemble that is observed": observed / own,
        f"us per impact of {starts:,} starts over {SHORT} cycles": 1e6 * seconds / impacts,
        f"times faster on {count} core(s) than on one": one_core / all_cores,
        "times faster than simulate_many": single / all_cores,
        "bytes of memory per start": 1024 * kilobytes / starts,
    }


@contextmanager
def _one_core():
    """On one core, where the system lets a process choose."""
    if not hasattr(os, "sched_setaffinity"):
        yield
        return
    allowed = os.sched_getaffinity(0)
    os.sched_setaffinity(0, [min(allowed)])
    try:
        yield
    finally:
        os.sched_setaffinity(0, allowed)


def _most_memory(anew=False):
    """The most memory that this process has had [kB], from now on if asked anew; nan where the system does not tell."""
    status = Path("/proc/self/status")
    if not status.exists():
        return float("nan")
    if anew:
        Path("/proc/self/clear_refs").write_text("5")
    return float(re.search(r"VmHWM:\s+(\d+)", status.read_text())[1])


def _impacts(system, states, cycles):
    return int(ensemble(system, states, cycles)["impacts"].sum())
