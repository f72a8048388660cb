"""Where the results of a build are, and the page to open first."""

from collections.abc import Iterable
from pathlib import Path

FIGURES = "results/figures/"
PAGES = {
    "report": "results/report/index.html",
    "figure_check": "results/figure_check/index.html",
    "compare_figures": "results/figure_check/index.html",
    "all": "results/notebooks/fig10_06.html",
    "figures": "results/notebooks/fig10_06.html",
}
"""The page of a rule; a figure has its own in results/notebooks/."""


def first_page(names: Iterable[str]) -> str | None:
    """The page of the first of these rules that has one."""
    pages = (PAGES.get(name, f"results/notebooks/{name}.html") for name in names)
    return next((page for page in pages if Path(page).is_file()), None)


def open_first(names: Iterable[str]) -> list[str]:
    """The line about that page, if there is one."""
    page = first_page(names)
    return [f"Open first: {page}"] if page else []


def made(outputs: Iterable[str]) -> str:
    """What the finished jobs have made, and where it is."""
    figures = sum(path.startswith(FIGURES) and path.endswith(".png") for path in outputs)
    return f"{figures} figure{'s' * (figures != 1)} in {FIGURES}" if figures else "Results are in results/"
