"""What the adapters share: a log file for each job, and CSV files."""

import contextlib
import os
import sys
from pathlib import Path

import pandas as pd

from vibroimpact.figures.kit.files import replacing


@contextlib.contextmanager
def logging_to(path):
    """Send everything that this process and its children print to a log file."""
    Path(path).parent.mkdir(parents=True, exist_ok=True)
    with open(path, "w", encoding="utf-8") as log:
        for stream in (sys.stdout, sys.stderr):
            stream.flush()
            os.dup2(log.fileno(), stream.fileno())
        yield


def write_csv(table: pd.DataFrame, path) -> None:
    """Write a table with as many digits as tell its numbers apart, at once or not at all."""
    with replacing(path) as partial:
        table.to_csv(partial, index=False, lineterminator="\n")
