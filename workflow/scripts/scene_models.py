"""For every figure with a model the rungs of the ladder, with error and cost -> scene_models.csv."""

import json
from pathlib import Path

import pandas as pd

from adapter import logging_to, write_csv
from vibroimpact.accuracy import scene_models
from vibroimpact.figures.kit import tables
from vibroimpact.system import System


def main(figures: dict, simulations: dict, folder, seconds: float, output) -> None:
    rows = []
    for figure, (scene, system) in figures.items():
        table = tables.read(Path(folder) / f"figures/{figure}.csv")
        settings = simulations.get(scene.get("case"))
        rungs = rungs_of(figure, scene, system, settings, table, Path(folder))
        print(f"{figure}: {len(rungs)} rungs")
        in_use = scene_models.in_use(scene, settings)
        rows += scene_models.rows(figure, scene, table, rungs, in_use, seconds)
    write_csv(pd.DataFrame(rows), output)


def rungs_of(figure, scene, system, settings, table, folder):
    """The rungs of one figure, from the results that it shows."""
    if scene["model"] == "closed_form":
        return scene_models.closed_form_rungs(figure, scene, system, table)
    case = scene["case"]
    system, points = System(**system), tables.read(folder / f"fixed_points/{case}.csv")
    if scene["model"] == "slow_flow":
        return scene_models.slow_flow_rungs(figure, scene, system, points, table)
    samples = tables.read(folder / f"simulations/{case}/samples.csv")
    if "digits" not in settings:
        return scene_models.settled_rungs(system, settings, points, samples)
    summary = json.loads((folder / f"simulations/{case}/summary.json").read_text(encoding="utf-8"))
    return scene_models.modulated_rungs(system, settings, points, samples, summary["trust"]["agreement"])


if "snakemake" in globals():
    with logging_to(snakemake.log[0]):
        main(
            snakemake.params.figures,
            snakemake.params.simulations,
            "results",
            snakemake.params.seconds,
            snakemake.output[0],
        )
