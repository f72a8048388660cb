"""Direct integration of one case -> its window after the transient: samples.csv, events.csv, summary.json; strobe.csv
holds the state at the start of every forcing cycle of the whole run.

With `digits` in the settings the run is carried with that many decimal digits and proved by doubling them.
"""

import json
from pathlib import Path

import numpy as np
import pandas as pd

from vibroimpact.accuracy.reference.run import proven_run
from vibroimpact.exact.engine.simulation import simulate
from vibroimpact.figures.kit import tables
from vibroimpact.system import System
from vibroimpact.system.state import KINDS, NAMES
from vibroimpact_pipeline.jobs import running

WINDOW = ("transient_cycles", "window_cycles", "samples_per_cycle")


def main(case: str, parameters: dict, settings: dict, out) -> None:
    system = System(**parameters)
    cycles = settings["transient_cycles"] + settings["window_cycles"]
    strobe = np.arange(settings["transient_cycles"]) * system.period
    times = window(system.period, *(settings[name] for name in WINDOW))
    run, trust = integrate(system, settings, cycles, np.concatenate([strobe, times]))
    samples, events = run.samples[len(strobe) :], run.events[run.events["tau"] >= times[0]]
    every = slice(None, None, settings["samples_per_cycle"])
    tables.write(states_table(times, samples), out.samples)
    tables.write(events_table(events), out.events)
    starts = np.concatenate([run.samples[: len(strobe)], samples[every]])
    tables.write(states_table(np.concatenate([strobe, times[every]]), starts), out.strobe)
    numbers = summarise(times, samples, events, settings)
    summary = {"case": case, "system": parameters, "settings": settings, **numbers, "trust": trust}
    Path(out.summary).write_text(json.dumps(summary, indent=2) + "\n", encoding="utf-8")


def integrate(system: System, settings: dict, cycles: int, times: np.ndarray):
    """The run, and what vouches for it."""
    if "digits" not in settings:
        run = simulate(system, settings["initial_state"], cycles, sample_times=times)
        certificate = {name: value for name, value in vars(run.certificate).items() if np.isfinite(value)}
        return run, {"method": "float64", "certificate": certificate}
    proof = proven_run(system, settings["initial_state"], cycles, digits=settings["digits"], sample_times=times)
    digits = [proof.coarse.digits, proof.run.digits]
    return proof.run, {"method": "arbitrary precision", "digits": digits, "agreement": proof.agreement}


def window(period: float, transient_cycles: int, window_cycles: int, samples_per_cycle: int) -> np.ndarray:
    """Sample times of the window, both ends included, the same phases in every cycle."""
    return (transient_cycles + np.arange(window_cycles * samples_per_cycle + 1) / samples_per_cycle) * period


def states_table(times: np.ndarray, states: np.ndarray) -> pd.DataFrame:
    return pd.DataFrame(np.column_stack([times, states]), columns=["tau", *NAMES])


def events_table(events: np.ndarray) -> pd.DataFrame:
    """One row per event, with the state just after it."""
    table = pd.DataFrame({name: events[name] for name in ("tau", "module", "wall")})
    table["kind"] = [KINDS[kind] for kind in events["kind"]]
    table[list(NAMES)] = events["state"]
    return table


def summarise(times: np.ndarray, samples: np.ndarray, events: np.ndarray, settings: dict) -> dict:
    """Numbers of the window: events by kind and module, and how near the motion returns after 1 to 4 cycles."""
    counts = {
        name: {str(module): int(np.sum((events["kind"] == kind) & (events["module"] == module))) for module in (1, 2)}
        for kind, name in KINDS.items()
    }
    per_cycle = settings["samples_per_cycle"]
    returns = {
        str(cycles): float(np.abs(samples[cycles * per_cycle :] - samples[: -cycles * per_cycle]).max())
        for cycles in range(1, min(4, settings["window_cycles"]) + 1)
    }
    return {
        "window": [times[0], times[-1]],
        "events": counts,
        "largest_change_after_cycles": returns,
        "final": samples[-1].tolist(),
    }


with running(snakemake) as out:
    main(snakemake.wildcards.case, snakemake.params.system, snakemake.params.settings, out)
