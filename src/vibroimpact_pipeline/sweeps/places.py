"""Where the files of a sweep lie."""

import math
from pathlib import Path

MOST_IN_CSV = 1_000_000
"""Rows of a table that are read as text in some seconds; a longer one is Parquet."""


def tile_path(sweep: str, number: int, tiles: int) -> Path:
    """Where one of so many tiles is, counted from 1."""
    return Path(f"results/sweeps/{sweep}/tiles/{number}-of-{tiles}.csv")


def table_path(sweep: str, axes: list[dict]) -> str:
    """Where the whole table is, of a sweep over axes as the config has them."""
    points = math.prod(
        axis.get("cells") or axis.get("values") or len(axis.get("listed") or axis["tuples"]) for axis in axes
    )
    return f"results/sweeps/{sweep}.{'csv' if points <= MOST_IN_CSV else 'parquet'}"
