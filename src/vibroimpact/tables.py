"""Tidy tables of plotted numbers, to a CSV file and back without loss.

Every table has the columns `panel` and `series`, then one column per plotted quantity, named as on the axis;
`label` names single points. A quantity that a row does not have is left blank.
"""

import numpy as np

from vibroimpact.system.extras import need

need("figures", "pandas")

import pandas as pd  # noqa: E402 (after the word on what is missing)

TEXT = ("panel", "series", "label")
SAID = (*TEXT, "failed")
"""Columns of words, blank where there is none; in all others a blank is a missing value."""


def curve(panel: str, series: str, **quantities) -> pd.DataFrame:
    """Return the rows of one curve or point set; quantities are arrays (n,) or scalars, broadcast."""
    values = np.broadcast_arrays(*(np.atleast_1d(quantity) for quantity in quantities.values()))
    columns = dict(zip(quantities, values, strict=True))
    return pd.DataFrame({"panel": panel, "series": series, **columns})


def join(curves) -> pd.DataFrame:
    """Return one tidy table of several curves: the union of their columns, text columns first."""
    table = pd.concat(list(curves), ignore_index=True)
    text = [name for name in TEXT if name in table]
    table[text] = table[text].fillna("")
    return table[text + [name for name in table if name not in text]]


def select(table: pd.DataFrame, panel: str, series: str) -> pd.DataFrame:
    """Return the rows of one series of one panel, in plotting order."""
    return table[(table["panel"] == panel) & (table["series"] == series)]


def write(table: pd.DataFrame, path) -> None:
    """Write a table with as many digits as tell its numbers apart."""
    table.to_csv(path, index=False, lineterminator="\n")


def read(path) -> pd.DataFrame:
    """Read a table that `write` wrote, equal to the last digit."""
    table = pd.read_csv(path, dtype=dict.fromkeys(SAID, str))
    text = [name for name in SAID if name in table]
    table[text] = table[text].fillna("")
    return table
