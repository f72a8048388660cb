"""What the adapters share: a log file for each job, and CSV files."""

import contextlib
import sys
import traceback
from pathlib import Path

import pandas as pd

from vibroimpact.figures.atomic import replacing


@contextlib.contextmanager
def logging_to(path):
    """Send everything printed to a log file, a traceback included, and fail then without repeating it."""
    Path(path).parent.mkdir(parents=True, exist_ok=True)
    with open(path, "w", encoding="utf-8") as log, contextlib.redirect_stdout(log), contextlib.redirect_stderr(log):
        try:
            yield
        except Exception:
            traceback.print_exc()
            sys.exit(1)


def write_csv(table: pd.DataFrame, path) -> None:
    """Write a table with as many digits as tell its numbers apart, at once or not at all."""
    with replacing(path) as partial:
        table.to_csv(partial, index=False, lineterminator="\n")


def read_csv(path) -> pd.DataFrame:
    """Read a table that `write_csv` wrote, equal to the last digit."""
    return pd.read_csv(path, float_precision="round_trip")
