"""One companion figure of the regimes -> the files of the figure and the tables beside it."""

from importlib import import_module

import pandas as pd

from adapter import logging_to, write_csv
from vibroimpact.figures.style import save
from vibroimpact.system import System


def main(module: str, settings: dict, tiles, outputs: dict) -> None:
    """Compute the figure of a library module, write every table that has a file, and draw."""
    figure = import_module(f"vibroimpact.figures.{module}")
    tables = figure.compute(**arguments(settings, tiles))
    for name in tables.keys() & outputs.keys():
        write_csv(tables[name], outputs[name])
    save(figure.draw(tables), outputs)


def arguments(settings: dict, tiles) -> dict:
    """The settings with systems made of their parameters, and with tiles read from their files, if there are any."""
    made = dict(settings)
    if "system" in made:
        made["system"] = System(**made["system"])
    if "systems" in made:
        made["systems"] = {case: System(**parameters) for case, parameters in made["systems"].items()}
    if tiles:
        made["tiles"] = [pd.read_csv(path) for path in tiles]
    return made


if "snakemake" in globals():
    with logging_to(snakemake.log[0]):
        outputs = dict(snakemake.output.items())
        main(snakemake.params.module, snakemake.params.settings, list(snakemake.input), outputs)
