"""Results of the build -> the chapter's claims with their verdicts: claims.json, and claims.md to read.

In a build with other parameters than the chapter's none is judged, and both files say why.
"""

import json
from pathlib import Path

import pandas as pd
import yaml

from job_log import logging_to
from vibroimpact.claims.evidence import Evidence, Simulation
from vibroimpact.claims.judge import judge, leave_open, to_markdown
from vibroimpact.figures.kit.files import replacing
from vibroimpact.system import System

TABLES = ("fixed_points", "orbits", "verdict_grid", "modulation", "special_points", "epsilon_orders")


def main(claims, systems: dict, departures: list[str], inputs: dict, outputs: dict) -> None:
    listed = yaml.safe_load(Path(claims).read_text(encoding="utf-8"))["claims"]
    judged = leave_open(listed) if departures else judge(listed, evidence(systems, inputs))
    texts = {"json": json.dumps(judged, indent=1) + "\n", "markdown": to_markdown(judged, departures)}
    for name, text in texts.items():
        with replacing(outputs[name]) as partial:
            partial.write_text(text, encoding="utf-8")


def evidence(systems: dict, inputs: dict) -> Evidence:
    """What the checks look at; the simulation of a case is given by the inputs <case>_samples, _events, _summary."""
    simulated = {name.removesuffix("_summary") for name in inputs if name.endswith("_summary")}
    return Evidence(
        systems={case: System(**parameters) for case, parameters in systems.items()},
        proofs=json.loads(Path(inputs["proofs"]).read_text(encoding="utf-8")),
        simulations={case: simulation(case, inputs) for case in sorted(simulated)},
        **{name: pd.read_csv(inputs[name]) for name in TABLES},
    )


def simulation(case: str, inputs: dict) -> Simulation:
    samples, events = (pd.read_csv(inputs[f"{case}_{name}"]) for name in ("samples", "events"))
    summary = json.loads(Path(inputs[f"{case}_summary"]).read_text(encoding="utf-8"))
    return Simulation(samples, events, summary)


if "snakemake" in globals():
    with logging_to(snakemake.log[0]):
        inputs, outputs = dict(snakemake.input.items()), dict(snakemake.output.items())
        claims = inputs.pop("claims")
        main(claims, snakemake.params.systems, snakemake.params.departures, inputs, outputs)
