"""Compute and write the tables of one figure, and draw the figure from the written tables."""

from importlib import import_module

from vibroimpact_pipeline import provenance
from vibroimpact_pipeline.jobs import running

from vibroimpact import tables
from vibroimpact.figures.plotting.style import write_and_draw
from vibroimpact.system import System


def arguments(params, inputs) -> dict:
    """Return the arguments of `compute`: settings, the system of the case or those of all cases, tables."""
    given = dict(params.settings)
    if params.get("system"):
        given["system"] = System(**params.system)
    if params.get("systems"):
        given["systems"] = {case: System(**parameters) for case, parameters in params.systems.items()}
    return given | {name: tables.read(path) for name, path in inputs.items()}


with running(snakemake) as out:
    module = import_module(snakemake.params.module)
    write_and_draw(module, module.compute(**arguments(snakemake.params, snakemake.input)), vars(out))
    provenance.write(snakemake, out)
