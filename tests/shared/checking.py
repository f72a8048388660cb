"""Figures written as the pipeline does, and what a verdict of the figure check must say."""

from pipeline_trees import ROOT
from vibroimpact.figures.kit import style, tables
from vibroimpact_pipeline.data_dictionary import compared, read
from vibroimpact_pipeline.figure_check.compare import tolerances

CARDS, _ = read(ROOT)
LIMITS = tolerances(compared(CARDS))


def build(folder, name, table, figure, picture=True):
    """Write the files of a figure that the figure check compares."""
    if table is not None:
        tables.write(table, folder / f"{name}.csv")
    outputs = {"artists": folder / f"{name}.artists.json"} | ({"png": folder / f"{name}.png"} if picture else {})
    style.save(figure, outputs)


def assert_caught(verdict, by):
    assert verdict["status"] == "failed"
    assert any(by in reason for reason in verdict["reasons"]), verdict["reasons"]
