"""A table of results, and how it becomes CSV: every number with as many digits as tell it apart."""

import csv
from dataclasses import dataclass


@dataclass(frozen=True)
class Table:
    """Names of the columns, and rows of numbers, words and truth values."""

    columns: tuple[str, ...]
    rows: list[tuple]

    def write(self, file) -> None:
        """Write CSV to an open text file."""
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(self.columns)
        writer.writerows(self.rows)
