"""How far a table of plotted numbers is from its reference, column by column."""

from collections import Counter
from dataclasses import dataclass

import numpy as np
import pandas as pd

TEXT = ("panel", "series", "label")


@dataclass(frozen=True)
class Distance:
    """Largest distance of a column from its reference, as a share of its axis, and the row where it is found."""

    column: str
    share: float
    row: str
    reference: float
    new: float


def differences_in_structure(reference: pd.DataFrame, new: pd.DataFrame) -> list[str]:
    """What keeps two tables from being compared row by row: other columns, other rows, other blanks; one line each."""
    if list(reference.columns) != list(new.columns):
        return [f"columns {', '.join(new.columns)} instead of {', '.join(reference.columns)}"]
    old_rows, new_rows = _names(reference), _names(new)
    counts, new_counts = Counter(old_rows), Counter(new_rows)
    found = [
        f"{name}: {new_counts[name] or 'no'} rows instead of {counts[name] or 'none'}"
        for name in dict.fromkeys([*old_rows, *new_rows])
        if counts[name] != new_counts[name]
    ]
    if not found and old_rows != new_rows:
        found = ["the same rows in another order"]
    if not found:
        blanks = reference.isna() != new.isna()
        found = [f"{name}: blank in other rows" for name in reference if blanks[name].any()]
    return found


def distances(reference: pd.DataFrame, new: pd.DataFrame) -> list[Distance]:
    """Distance of each column of numbers between tables of the same structure.

    A difference counts as a share of the range of the reference's column in its panel; where that range is zero,
    and in tables without panels, as a share of the reference itself. What is not finite is infinitely far.
    """
    return [_distance(reference, new, name) for name in numeric_columns(reference) if reference[name].notna().any()]


def numeric_columns(table: pd.DataFrame) -> list[str]:
    return list(table.select_dtypes("number").columns)


def _distance(reference, new, name):
    old_values, new_values = (pd.to_numeric(table[name], errors="coerce").to_numpy(float) for table in (reference, new))
    shares = np.abs(new_values - old_values) / _scales(reference, name)
    shares = np.where(np.isnan(old_values), 0.0, np.where(np.isfinite(shares), shares, np.inf))
    row = int(shares.argmax())
    where = f"{_names(reference)[row]}, row {row + 1}"
    return Distance(name, float(shares[row]), where, float(old_values[row]), float(new_values[row]))


def _scales(reference, name):
    values = reference[name]
    sizes = values.abs().where(values != 0, 1.0).to_numpy(float)
    if "panel" not in reference:
        return sizes
    panels = values.groupby(reference["panel"])
    ranges = (panels.transform("max") - panels.transform("min")).to_numpy(float)
    return np.where(ranges > 0, ranges, sizes)


def _names(table):
    """The text of each row, for example "a1, SIM stable"."""
    text = [name for name in table if name not in numeric_columns(table)]
    return [", ".join(map(str, row)) for row in table[text].itertuples(index=False)]
