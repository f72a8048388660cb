"""Where the results of a build are, and the page to open first."""

import os
from collections.abc import Iterable
from pathlib import Path

START = os.getcwd()
"""Where the command was given: Snakemake loads its plugins before it goes where `--directory` says."""
FIGURES, ARCHIVE = "results/figures/", "results/archive/"
PAGES = {
    "report": "results/report/index.html",
    "figure_check": "results/figure_check/index.html",
    "figure_check_strict": "results/figure_check/index.html",
    "compare_figures": "results/figure_check/index.html",
    "all": "results/notebooks/fig10_06.html",
    "figures": "results/notebooks/fig10_06.html",
}
"""The page of a rule; a figure has its own in results/notebooks/."""
SWEEP = "sweep_"
"""What the names of sweeps begin with; each has its own page, too."""


def first_page(names: Iterable[str]) -> str | None:
    """The page of the first of these rules that has one."""
    return next((page for page in map(_page, names) if Path(page).is_file()), None)


def _page(name):
    if name.startswith(SWEEP):
        return f"results/sweeps/{name.removeprefix(SWEEP)}.html"
    return PAGES.get(name, f"results/notebooks/{name}.html")


def open_first(names: Iterable[str]) -> list[str]:
    """The line about that page, if there is one."""
    page = first_page(names)
    return [f"Open first: {from_start(page)}"] if page else []


def made(outputs: Iterable[str]) -> str:
    """What the finished jobs have made, and where it is."""
    outputs = list(outputs)
    figures = sum(path.startswith(FIGURES) and path.endswith(".png") for path in outputs)
    if archive := next((path for path in outputs if path.startswith(ARCHIVE)), None):
        return f"The archive is {from_start(archive)}"
    if figures:
        return f"{figures} figure{'s' * (figures != 1)} in {from_start(FIGURES)}/"
    return f"Results are in {from_start('results')}/"


def from_start(path) -> str:
    """A path as the user's shell finds it."""
    return os.path.relpath(path, START)
