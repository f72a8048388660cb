"""Figures written as the pipeline does, and what a verdict of the figure check must say."""

import shutil

from pipeline_trees import ROOT
from vibroimpact.figures.kit import style, tables
from vibroimpact_pipeline.data_dictionary import compared, read
from vibroimpact_pipeline.figure_check.compare import all_figures, check, tolerances
from vibroimpact_pipeline.figure_check.page import page, shown

PICTURES = "png", "pdf", "svg"
CARDS, _ = read(ROOT)
LIMITS = tolerances(compared(CARDS))


def build(folder, name, table, figure, pictures=True):
    """Write the files of a figure that the figure check looks at."""
    if table is not None:
        tables.write(table, folder / f"{name}.csv")
    kinds = [*PICTURES] if pictures else []
    style.save(
        figure, {kind: folder / f"{name}.{kind}" for kind in kinds} | {"artists": folder / f"{name}.artists.json"}
    )


def copy_pictures(name, source, folder):
    for kind in PICTURES:
        shutil.copy(source / f"{name}.{kind}", folder)


def check_all(figures, reference, new, limits):
    """Verdicts as the rule asks for them, one figure after the other."""
    return [check(figure, reference, new, limits) for figure in all_figures(figures, reference)]


def page_of(verdicts, reference, new):
    return page(verdicts, {each["figure"]: shown(each["figure"], reference, new) for each in verdicts}, LIMITS)


def assert_caught(verdict, by):
    assert verdict["status"] == "failed"
    assert any(by in reason for reason in verdict["reasons"]), verdict["reasons"]
