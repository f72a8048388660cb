"""Tiles of a sweep as files: whose they are, and all of them together."""

import csv
from collections.abc import Iterable, Iterator
from pathlib import Path

import pandas as pd

from vibroimpact.figures.kit.tables import read
from vibroimpact.sweeps.asked import POINT
from vibroimpact.sweeps.grid import Grid

OF = "of"
"""The column that holds the fingerprint of what was asked for."""


class NotOfThisSweep(ValueError):
    """Tiles do not make up the sweep."""


def is_of(path: Path, fingerprint: str) -> bool:
    """Whether a tile is there, of a sweep with this fingerprint."""
    try:
        with open(path, encoding="utf-8", newline="") as file:
            return next(csv.DictReader(file), {}).get(OF) == fingerprint
    except OSError:
        return False


def gathered(paths: Iterable, fingerprint: str, grid: Grid) -> pd.DataFrame:
    """The rows of all tiles in the order of the points.

    Raises:
        NotOfThisSweep: a tile is of something else, or a point is missing or there twice.
    """
    table = pd.concat(list(_parts(paths, fingerprint)), ignore_index=True).sort_values(POINT, ignore_index=True)
    if table[POINT].tolist() != list(range(len(grid))):
        raise NotOfThisSweep(
            f"the tiles hold {table[POINT].nunique()} different points in {len(table)} rows, "
            f"not {len(grid)} once each. Delete them and build again."
        )
    return table


def _parts(paths, fingerprint) -> Iterator[pd.DataFrame]:
    for path in paths:
        part = read(path)
        if set(part[OF]) != {fingerprint}:
            raise NotOfThisSweep(f"{path} is of a sweep that asked for something else. Delete it and build again.")
        yield part.drop(columns=OF)
