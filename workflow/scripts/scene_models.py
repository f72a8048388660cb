"""For every figure with a model the rungs of the ladder, with error and cost -> scene_models.csv."""

import json
from functools import partial
from importlib import import_module
from pathlib import Path

import pandas as pd

from job import running
from vibroimpact.accuracy import scene_models
from vibroimpact.figures.kit import tables
from vibroimpact.figures.kit.fixed_point_table import labelled_points
from vibroimpact.figures.kit.legibility import smallest_visible_error
from vibroimpact.figures.kit.style import drawn
from vibroimpact.system import System
from vibroimpact.system.state import NAMES
from vibroimpact.system.verdict import STABLE


def main(figures: dict, simulations: dict, folder, seconds: float, output) -> None:
    """Measure the rungs of every figure: its scene in the config, the settings it is drawn from, the module's name."""
    rows = []
    for figure, (scene, settings, drawn_by) in figures.items():
        module, table = import_module(drawn_by), tables.read(Path(folder) / f"figures/{figure}.csv")
        simulation = simulations.get(scene.get("case"))
        rungs = rungs_of(figure, scene, settings, simulation, module, table, Path(folder))
        print(f"{figure}: {len(rungs)} rungs")
        in_use = scene_models.in_use(scene, simulation)
        rows += scene_models.rows(figure, smallest_visible_error(drawn(module, {"csv": table})), rungs, in_use, seconds)
    tables.write(pd.DataFrame(rows, columns=scene_models.COLUMNS), output)


def rungs_of(figure, scene, settings, simulation, module, table, folder):
    """The rungs of one figure, from the results that it shows."""
    if scene["model"] == "closed_form":
        return scene_models.closed_form_rungs(figure, scene, settings, table, partial(module.compute, **settings))
    case = scene["case"]
    system = System(**settings["system"])
    points = labelled_points(tables.read(folder / f"fixed_points/{case}.csv"))
    if scene["model"] == "slow_flow":
        return scene_models.slow_flow_rungs(scene, system, points)
    samples = tables.read(folder / f"simulations/{case}/samples.csv")
    orbits = tables.read(folder / f"orbits/{case}.csv")
    stable = orbits[orbits["admissible"] & (orbits["floquet"] == STABLE)][list(NAMES)].to_numpy(float)
    summary = json.loads((folder / f"simulations/{case}/summary.json").read_text(encoding="utf-8"))
    return scene_models.motion_rungs(system, simulation, summary, points, stable, samples)


if "snakemake" in globals():
    with running(snakemake):
        main(
            snakemake.params.figures,
            snakemake.params.simulations,
            Path(snakemake.output[0]).parents[1],
            snakemake.params.seconds,
            snakemake.output[0],
        )
