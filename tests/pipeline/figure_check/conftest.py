"""Fixtures of a small reference set, drawn by the tests since pictures depend on the versions of libraries."""

import datetime
import shutil
from types import SimpleNamespace

import pytest

from pipeline_trees import ROOT
from vibroimpact.tables import read, write
from vibroimpact_pipeline.figure_check import pictures
from vibroimpact_pipeline.figure_check.accept import accept
from vibroimpact_pipeline.figure_check.check import check, compared_files
from vibroimpact_pipeline.specs import spec_of, specs

FIGURES = ["fig10_02", "fig10_04", "fig10_06", "fig10_11"]
"""Figures without a table, with one table, with markers and arrows, and with two tables."""
SPECS = {figure: spec_of(figure, {}, specs()) for figure in FIGURES}
DAY = datetime.date(2020, 2, 29)


@pytest.fixture(scope="session")
def matching(tmp_path_factory):
    """Return a folder with a reference set and a build that match; their tables are the published tables."""
    folder = tmp_path_factory.mktemp("matching")
    for figure in FIGURES:
        for file, path in compared_files(figure, SPECS[figure]).values():
            (folder / "build" / path).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(ROOT / "figures" / file, folder / "build" / path)
        redraw(folder / "build", figure)
    (folder / "figures").mkdir()
    verdicts = [check(figure, SPECS[figure], folder / "figures", folder / "build") for figure in FIGURES]
    accept(verdicts, folder / "build", folder / "figures", "all are new", DAY)
    return folder


def redraw(build, figure):
    """Redraw the pictures of a figure in a build from the current tables."""
    spec = SPECS[figure]
    tables = {name: read(build / path) for name, (_, path) in compared_files(figure, spec).items()}
    (build / "results/figures").mkdir(parents=True, exist_ok=True)
    pictures.draw(spec["module"], tables, figure, build / "results/figures")


@pytest.fixture
def tree(matching, tmp_path):
    """Return a copy of reference set and build, and functions that change a table, redraw a figure or check it."""
    shutil.copytree(matching, tmp_path / "tree")
    reference, build = tmp_path / "tree/figures", tmp_path / "tree/build"
    results = build / "results/figures"

    def change(file, **columns):
        """Set columns of a table in the build to values or functions of the table, and redraw its figure."""
        write(read(results / file).assign(**columns), results / file)
        redraw(build, file.partition(".")[0])

    return SimpleNamespace(
        reference=reference,
        build=build,
        results=results,
        change=change,
        verdict=lambda figure: check(figure, SPECS[figure], reference, build),
        redraw=lambda figure: redraw(build, figure),
    )
