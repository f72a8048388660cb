"""For every figure with a model the levels of the model hierarchy, with error and cost -> scene_models.csv."""

import json
from functools import partial
from importlib import import_module
from pathlib import Path

import pandas as pd

from vibroimpact import tables
from vibroimpact.accuracy import scene_models
from vibroimpact.figures.plotting.legibility import smallest_visible_error
from vibroimpact.figures.plotting.style import draw_tables
from vibroimpact.frames import with_former_names
from vibroimpact.system import System
from vibroimpact.system.state import NAMES
from vibroimpact.system.verdict import STABLE
from vibroimpact.theory.fixed_points.table import labelled_points
from vibroimpact_pipeline.jobs import running
from vibroimpact_pipeline.specs import drawing_module, module_of, specs


def levels_of(figure, scene, params, simulation, module, table, folder):
    """Return the levels of the model hierarchy for one figure, from its results."""
    if scene["model"] == "closed_form":
        settings = params["settings"]
        return scene_models.closed_form_levels(figure, scene, settings, table, partial(module.compute, **settings))
    case, system = scene["case"], System(**params["system"])
    points = labelled_points(tables.read(folder / f"fixed_points/{case}.csv"))
    if scene["model"] == "slow_flow":
        return scene_models.slow_flow_levels(scene, system, points)
    samples = tables.read(folder / f"simulations/{case}/samples.csv")
    orbits = tables.read(folder / f"orbits/{case}.csv")
    stable = orbits[orbits["admissible"] & (orbits["exact"] == STABLE)][list(NAMES)].to_numpy(float)
    summary = json.loads((folder / f"simulations/{case}/summary.json").read_text(encoding="utf-8"))
    return scene_models.motion_levels(system, simulation, summary, points, stable, samples)


with running(snakemake) as out:
    rows, results, known = [], Path(snakemake.output.csv).parents[1], specs()
    for figure, (scene, params) in snakemake.params.figures.items():
        module = import_module(module_of(drawing_module(figure, scene, known)))
        table = tables.read(results / f"figures/{figure}.csv")
        simulation = snakemake.params.simulations.get(scene.get("case"))
        levels = levels_of(figure, scene, params, simulation, module, table, results)
        print(f"{figure}: {len(levels)} levels")
        visible = smallest_visible_error(draw_tables(module, {"csv": table}))
        used = scene_models.in_use(scene, simulation)
        rows += scene_models.rows(figure, visible, levels, used, snakemake.params.seconds)
    table = pd.DataFrame(rows, columns=scene_models.COLUMNS)
    tables.write(with_former_names(table, {"rung": "level"}), out.csv)
