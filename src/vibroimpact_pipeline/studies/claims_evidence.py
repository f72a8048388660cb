"""Read the evidence for judging the claims of the chapter from the results of a build."""

import json
from pathlib import Path

import pandas as pd

from vibroimpact.studies.claims.evidence import Evidence, Simulation
from vibroimpact.system.chapter import CASES

TABLES = "fixed_points", "orbits", "verdict_grid", "modulation", "special_points", "epsilon_orders"


def evidence(inputs: dict) -> Evidence:
    """Return the evidence for judging the claims of the chapter.

    `inputs` contains the path of each result by name. The results of the simulation of a case have the names
    <case>_samples, <case>_events and <case>_summary.
    """
    simulated = [name.removesuffix("_summary") for name in inputs if name.endswith("_summary")]
    return Evidence(
        proofs=json.loads(Path(inputs["proofs"]).read_text(encoding="utf-8")),
        simulations={case: simulation(case, inputs) for case in simulated},
        **{name: of_the_chapter(pd.read_csv(inputs[name])) for name in TABLES},
    )


def of_the_chapter(table: pd.DataFrame) -> pd.DataFrame:
    """Return the rows for the chapter's cases. If the table has no column "case", return all rows."""
    return table[table["case"].isin(CASES)].reset_index(drop=True) if "case" in table else table


def simulation(case: str, inputs: dict) -> Simulation:
    """Read the simulation of a case; `inputs` contains the path of each result by name, as in `evidence`."""
    samples, events = (pd.read_csv(inputs[f"{case}_{name}"]) for name in ("samples", "events"))
    summary = json.loads(Path(inputs[f"{case}_summary"]).read_text(encoding="utf-8"))
    return Simulation(samples, events, summary)
