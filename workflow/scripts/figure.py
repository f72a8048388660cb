"""Compute and write the tables of one figure, and draw the figure from the written tables.

The outputs `json` (interactive data) and `gif` (animation) are optional.
"""

import json
from importlib import import_module
from pathlib import Path

from vibroimpact_pipeline import provenance
from vibroimpact_pipeline.jobs import running

from vibroimpact import tables
from vibroimpact.figures.plotting.style import write_and_draw
from vibroimpact.system import System


def arguments(params, inputs) -> dict:
    """Return the arguments of `compute`: settings, tables and systems.

    The argument `system` is the system of one case. The argument `systems` contains the system of each case by name.
    Each of these two arguments is left out if the figure does not need it.
    """
    given = dict(params.settings)
    if params.get("system"):
        given["system"] = System(**params.system)
    if params.get("systems"):
        given["systems"] = {case: System(**parameters) for case, parameters in params.systems.items()}
    return given | {name: tables.read(path) for name, path in inputs.items()}


with running(snakemake) as out:
    module = import_module(snakemake.params.module)
    computed = module.compute(**arguments(snakemake.params, snakemake.input))
    write_and_draw(module, computed, vars(out))
    if "json" in vars(out):
        data = module.page_data(computed)
        Path(out.json).write_text(json.dumps(data, separators=(",", ":")) + "\n", encoding="utf-8")
        module.animate(computed, out.gif)
    provenance.write(snakemake, out)
