"""One companion figure -> the files of the figure and the tables beside it."""

import sys
from importlib import import_module

from job import running
from vibroimpact.figures.kit.style import save
from vibroimpact.figures.kit.tables import read, write
from vibroimpact.system import System
from vibroimpact_pipeline.config import with_key
from vibroimpact_pipeline.provenance.record import recorded


def main(module: str, settings: dict, inputs: dict, outputs: dict, provenance: dict) -> None:
    """Compute the figure of a library module, write every table that has a file, and draw.

    Args:
        module: its full name.
        settings: arguments of its `compute`, systems as their parameters.
        inputs: further arguments, as paths of tables or lists of such paths.
    """
    figure = import_module(module)
    given = with_systems(settings) | {name: read_all(paths) for name, paths in inputs.items()}
    try:
        computed = figure.compute(**given)
    except ValueError as error:
        if line := with_key(error, provenance["config"]):
            sys.exit(line)
        raise
    tables = computed if isinstance(computed, dict) else {"csv": computed}
    for name in tables.keys() & outputs.keys():
        write(tables[name], outputs[name])
    save(figure.draw(computed), outputs, provenance)


def with_systems(settings: dict) -> dict:
    """The settings with systems made of their parameters."""
    made = dict(settings)
    if "system" in made:
        made["system"] = System(**made["system"])
    if "systems" in made:
        made["systems"] = {case: System(**parameters) for case, parameters in made["systems"].items()}
    return made


def read_all(paths):
    return read(paths) if isinstance(paths, str) else [read(path) for path in paths]


if "snakemake" in globals():
    with running(snakemake), recorded(snakemake) as (provenance, outputs):
        main(snakemake.params.module, snakemake.params.settings, dict(snakemake.input.items()), outputs, provenance)
