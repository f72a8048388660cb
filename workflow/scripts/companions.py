"""One companion figure on stability -> the table it plots and the files of the figure."""

from importlib import import_module

import pandas as pd

from adapter import logging_to, write_csv
from vibroimpact.figures.style import save
from vibroimpact.system import System


def main(module: str, settings: dict, inputs: dict, outputs: dict) -> None:
    """Compute the figure of a library module from its settings and the tables it reads, by name, and draw it."""
    figure = import_module(f"vibroimpact.figures.{module}")
    made = {key: systems_of(value) if key == "systems" else value for key, value in settings.items()}
    table = figure.compute(**made, **{name: pd.read_csv(path) for name, path in inputs.items()})
    write_csv(table, outputs["csv"])
    save(figure.draw(table), outputs)


def systems_of(parameters: dict) -> dict:
    return {case: System(**values) for case, values in parameters.items()}


if "snakemake" in globals():
    with logging_to(snakemake.log[0]):
        inputs, outputs = dict(snakemake.input.items()), dict(snakemake.output.items())
        main(snakemake.params.module, snakemake.params.settings, inputs, outputs)
