"""One figure that no notebook draws -> its tables, and its pictures of the tables as they were written."""

from importlib import import_module

from job import running
from vibroimpact.figures.kit.style import write_and_draw
from vibroimpact.figures.kit.tables import read
from vibroimpact.system import System
from vibroimpact_pipeline.provenance.record import recorded


def main(module: str, settings: dict, inputs: dict, outputs: dict, provenance: dict) -> None:
    """Compute and draw the figure of a library module.

    Args:
        module: its full name.
        settings: arguments of its `compute`, systems as their parameters.
        inputs: further arguments, as paths of tables.
    """
    figure = import_module(module)
    given = with_systems(settings) | {name: read(path) for name, path in inputs.items()}
    write_and_draw(figure, figure.compute(**given), outputs, provenance)


def with_systems(settings: dict) -> dict:
    """The settings with systems made of their parameters."""
    made = dict(settings)
    if "system" in made:
        made["system"] = System(**made["system"])
    if "systems" in made:
        made["systems"] = {case: System(**parameters) for case, parameters in made["systems"].items()}
    return made


if "snakemake" in globals():
    with running(snakemake), recorded(snakemake) as (provenance, outputs):
        main(snakemake.params.module, snakemake.params.settings, dict(snakemake.input.items()), outputs, provenance)
