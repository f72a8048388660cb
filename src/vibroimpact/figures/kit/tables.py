"""Tidy tables of plotted numbers, to a file and back without loss: CSV, or Parquet where the name says so.

Every table has the columns `panel` and `series`, then one column per plotted quantity, named as on the axis;
`label` names single points. A quantity that a row does not have is left blank.
"""

from pathlib import Path

import numpy as np
import pandas as pd

from vibroimpact.figures.kit.files import replacing

TEXT = ("panel", "series", "label")
SAID = (*TEXT, "failed")
"""Columns of words, blank where there is none; in all others a blank is a missing value."""
PARQUET = ".parquet"


def curve(panel: str, series: str, **quantities) -> pd.DataFrame:
    """Rows of one curve or point set; quantities are arrays (n,) or scalars, broadcast."""
    values = np.broadcast_arrays(*(np.atleast_1d(quantity) for quantity in quantities.values()))
    columns = dict(zip(quantities, values, strict=True))
    return pd.DataFrame({"panel": panel, "series": series, **columns})


def join(curves) -> pd.DataFrame:
    """One tidy table of several curves: the union of their columns, text columns first."""
    table = pd.concat(list(curves), ignore_index=True)
    text = [name for name in TEXT if name in table]
    table[text] = table[text].fillna("")
    return table[text + [name for name in table if name not in text]]


def select(table: pd.DataFrame, panel: str, series: str) -> pd.DataFrame:
    """The rows of one series of one panel, in plotting order."""
    return table[(table["panel"] == panel) & (table["series"] == series)]


def write(table: pd.DataFrame, path) -> None:
    """Write a table with as many digits as tell its numbers apart."""
    with replacing(path) as partial:
        if Path(path).suffix == PARQUET:
            from fastparquet import write as write_parquet  # few tables are so long

            write_parquet(str(partial), table)
        else:
            table.to_csv(partial, index=False, lineterminator="\n")


def read(path) -> pd.DataFrame:
    """Read a table that `write` wrote, equal to the last digit."""
    table = _columnar(path) if Path(path).suffix == PARQUET else pd.read_csv(path, dtype=dict.fromkeys(SAID, str))
    text = [name for name in SAID if name in table]
    table[text] = table[text].fillna("")
    return table


def _columnar(path):
    from fastparquet import ParquetFile

    with open(path, "rb") as file:
        table = ParquetFile(file).to_pandas()
    return table.astype({name: str for name in table if table[name].dtype == object})
