"""Read the evidence for judging the claims of the chapter from the results of a build."""

import json
from pathlib import Path

import pandas as pd

from vibroimpact.studies.claims.evidence import Evidence, Simulation
from vibroimpact.system import System
from vibroimpact.system.chapter import CASES
from vibroimpact_pipeline.specs import case_parameters

TABLES = (
    *("fixed_points", "orbits", "verdict_grid", "modulation", "special_points", "epsilon_orders"),
    *("absorber", "clearance"),
)


def evidence(config: dict, inputs: dict, departures: dict[str, str]) -> Evidence:
    """Return the evidence on the cases of the chapter.

    Args:
        config: the config.
        inputs: paths of results by name; simulations are named <case>_samples, <case>_events and <case>_summary.
        departures: for parts of the evidence, why they do not apply to the chapter; missing results are added.
    """
    cases = [case for case in CASES if case in config["cases"]]
    simulated = {name.removesuffix("_summary") for name in inputs if name.endswith("_summary")}
    proofs = json.loads(Path(inputs["proofs"]).read_text(encoding="utf-8"))
    missing = {name: f"{name} is missing in this build" for name in TABLES if name not in inputs}
    return Evidence(
        systems={case: System(**case_parameters(config, case)) for case in cases},
        proofs={case: proofs[case] for case in cases},
        simulations={case: simulation(case, inputs) for case in sorted(simulated)},
        **{name: of_the_chapter(pd.read_csv(inputs[name])) for name in TABLES if name in inputs},
        **dict.fromkeys(missing),
        unlike=missing | departures,
    )


def of_the_chapter(table: pd.DataFrame) -> pd.DataFrame:
    """Return the rows of the chapter's cases, or all rows of a table without the column case."""
    return table[table["case"].isin(CASES)].reset_index(drop=True) if "case" in table else table


def simulation(case: str, inputs: dict) -> Simulation:
    samples, events = (pd.read_csv(inputs[f"{case}_{name}"]) for name in ("samples", "events"))
    summary = json.loads(Path(inputs[f"{case}_summary"]).read_text(encoding="utf-8"))
    return Simulation(samples, events, summary)
