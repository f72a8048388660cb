"""Where the results of a build are."""

import os
from collections.abc import Iterable

START = os.getcwd()
"""Where the command was given: Snakemake loads its plugins before it goes where `--directory` says."""
FIGURES, ARCHIVE = "results/figures/", "results/archive/"


def open_first(names: Iterable[str]) -> list[str]:
    """The line about the page to open after a build of these targets, if there is one."""
    from vibroimpact_pipeline.results_page import first_page  # now that rules elsewhere have brought their own library

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
