"""Results of the build -> the chapter's claims with their verdicts: claims.json, and claims.md to read.

In a build with other parameters than the chapter's, or other settings behind them, none is judged; both files say why.
"""

import json
from pathlib import Path

import pandas as pd
import yaml

from job import running
from vibroimpact.claims.evidence import Evidence, Simulation
from vibroimpact.claims.judge import judge, leave_open, to_markdown
from vibroimpact.figures.kit.files import replacing
from vibroimpact.system import System
from vibroimpact.system.chapter import CASES

TABLES = (
    *("fixed_points", "orbits", "verdict_grid", "modulation", "special_points", "epsilon_orders"),
    *("absorber", "clearance"),
)


def main(claims, systems: dict, unlike: list[str], inputs: dict, outputs: dict) -> None:
    listed = yaml.safe_load(Path(claims).read_text(encoding="utf-8"))["claims"]
    judged = leave_open(listed) if unlike else judge(listed, evidence(systems, inputs))
    texts = {"json": json.dumps(judged, indent=1) + "\n", "markdown": to_markdown(judged, unlike)}
    for name, text in texts.items():
        with replacing(outputs[name]) as partial:
            partial.write_text(text, encoding="utf-8")


def evidence(systems: dict, inputs: dict) -> Evidence:
    """What the checks look at, of the chapter's cases alone; simulations are the inputs <case>_samples, and so on."""
    simulated = {name.removesuffix("_summary") for name in inputs if name.endswith("_summary")}
    proofs = json.loads(Path(inputs["proofs"]).read_text(encoding="utf-8"))
    return Evidence(
        systems={case: System(**systems[case]) for case in CASES},
        proofs={case: proofs[case] for case in CASES},
        simulations={case: simulation(case, inputs) for case in sorted(simulated)},
        **{name: of_the_chapter(pd.read_csv(inputs[name])) for name in TABLES},
    )


def of_the_chapter(table: pd.DataFrame) -> pd.DataFrame:
    """The rows of its cases, where rows have one."""
    return table[table["case"].isin(CASES)].reset_index(drop=True) if "case" in table else table


def simulation(case: str, inputs: dict) -> Simulation:
    samples, events = (pd.read_csv(inputs[f"{case}_{name}"]) for name in ("samples", "events"))
    summary = json.loads(Path(inputs[f"{case}_summary"]).read_text(encoding="utf-8"))
    return Simulation(samples, events, summary)


if "snakemake" in globals():
    with running(snakemake):
        inputs, outputs = dict(snakemake.input.items()), dict(snakemake.output.items())
        claims = inputs.pop("claims")
        main(claims, snakemake.params.systems, snakemake.params.unlike, inputs, outputs)
