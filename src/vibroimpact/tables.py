"""Build tidy tables of plotted numbers, and write and read them as CSV without loss.

Every table has the columns `panel` and `series`, and one column for each plotted quantity. The column `label`, if
present, contains the names of single points. If a row has no value of a quantity, the field in the CSV file is blank.
"""

import numpy as np

from vibroimpact.system.extras import need

need("figures", "pandas")

import pandas as pd  # noqa: E402 (after the dependency check)

TEXT = ("panel", "series", "label")
BLANK_TEXT = (*TEXT, "failed")
"""Text columns. A blank field is an empty text in these columns, and a missing value in all other columns."""


def curve(panel: str, series: str, **quantities) -> pd.DataFrame:
    """Return the n rows of one curve or point set.

    The keyword arguments are the columns. The values of a column are an array of shape (n,), or a scalar that holds for
    all rows.
    """
    values = np.broadcast_arrays(*(np.atleast_1d(quantity) for quantity in quantities.values()))
    columns = dict(zip(quantities, values, strict=True))
    return pd.DataFrame({"panel": panel, "series": series, **columns})


def join(curves) -> pd.DataFrame:
    """Return one tidy table of several curves.

    The columns of all curves are columns of the table. Text columns come first.
    """
    table = pd.concat(list(curves), ignore_index=True)
    text = [name for name in TEXT if name in table]
    table[text] = table[text].fillna("")
    return table[text + [name for name in table if name not in text]]


def select(table: pd.DataFrame, panel: str, series: str) -> pd.DataFrame:
    """Return the rows of one series in one panel, in plotting order."""
    return table[(table["panel"] == panel) & (table["series"] == series)]


def write(table: pd.DataFrame, path) -> None:
    """Write a table as CSV, with all digits that are needed to read its numbers back exactly."""
    table.to_csv(path, index=False, lineterminator="\n")


def read(path) -> pd.DataFrame:
    """Read a table that was saved by `write`, with exactly the same numbers."""
    table = pd.read_csv(path, dtype=dict.fromkeys(BLANK_TEXT, str))
    text = [name for name in BLANK_TEXT if name in table]
    table[text] = table[text].fillna("")
    return table
