"""Direct integration of one case -> its window after the transient: samples.csv, events.csv, summary.json."""

import json

import numpy as np
import pandas as pd

from adapter import logging_to, write_csv
from vibroimpact.exact.simulation import KINDS, Run, simulate
from vibroimpact.figures.atomic import replacing
from vibroimpact.system import System

STATE = ["X1", "Y1", "X2", "Y2", "dX1", "dY1", "dX2", "dY2"]


def main(case: str, parameters: dict, settings: dict, outputs) -> None:
    system = System(**parameters)
    times = window(system.period, **{name: settings[name] for name in settings if name != "initial_state"})
    cycles = settings["transient_cycles"] + settings["window_cycles"]
    run = simulate(system, settings["initial_state"], cycles, sample_times=times)
    events = run.events[run.events["tau"] >= times[0]]
    write_csv(samples_table(times, run), outputs["samples"])
    write_csv(events_table(events), outputs["events"])
    with replacing(outputs["summary"]) as partial:
        summary = {"case": case, "system": parameters, "settings": settings, **summarise(times, run, events, settings)}
        partial.write_text(json.dumps(summary, indent=2) + "\n", encoding="utf-8")


def window(period: float, transient_cycles: int, window_cycles: int, samples_per_cycle: int) -> np.ndarray:
    """Sample times of the window, both ends included, the same phases in every cycle."""
    return (transient_cycles + np.arange(window_cycles * samples_per_cycle + 1) / samples_per_cycle) * period


def samples_table(times: np.ndarray, run: Run) -> pd.DataFrame:
    return pd.DataFrame(np.column_stack([times, run.samples]), columns=["tau", *STATE])


def events_table(events: np.ndarray) -> pd.DataFrame:
    """One row per event, with the state just after it."""
    table = pd.DataFrame({name: events[name] for name in ("tau", "module", "wall")})
    table["kind"] = [KINDS[kind] for kind in events["kind"]]
    table[STATE] = events["state"]
    return table


def summarise(times: np.ndarray, run: Run, events: np.ndarray, settings: dict) -> dict:
    """Numbers of the window: events by kind and module, and how near the motion returns after 1 to 4 cycles."""
    counts = {
        name: {str(module): int(np.sum((events["kind"] == kind) & (events["module"] == module))) for module in (1, 2)}
        for kind, name in KINDS.items()
    }
    per_cycle = settings["samples_per_cycle"]
    returns = {
        str(cycles): float(np.abs(run.samples[cycles * per_cycle :] - run.samples[: -cycles * per_cycle]).max())
        for cycles in range(1, min(4, settings["window_cycles"]) + 1)
    }
    return {
        "window": [times[0], times[-1]],
        "events": counts,
        "largest_change_after_cycles": returns,
        "final": run.final.tolist(),
    }


if "snakemake" in globals():
    with logging_to(snakemake.log[0]):
        main(snakemake.wildcards.case, snakemake.params.system, snakemake.params.settings, snakemake.output)
