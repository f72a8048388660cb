"""Is the case in a file the one that was asked for? Two files that have changed places look well each by itself."""

import csv
import json
from pathlib import Path

CASE = "case"
"""The column of a table, or the entry of a JSON file, that names the case."""


class OtherCase(ValueError):
    """A file holds a case that nobody asked for."""


def expect(case: str, paths) -> None:
    """Look into the tables and JSON files that name their case; others are passed over.

    Raises:
        OtherCase: a file holds another case.
    """
    for path in paths:
        if others := _cases(Path(path)) - {case}:
            raise OtherCase(f"{path} is of case {', '.join(sorted(others))}, not {case}. Delete it and build again.")


def _cases(path):
    read = READERS.get(path.suffix)
    return read(path) if read else set()


def _in_table(path):
    with open(path, encoding="utf-8", newline="") as file:
        table = csv.DictReader(file)
        return {row[CASE] for row in table} if CASE in (table.fieldnames or []) else set()


def _in_json(path):
    content = json.loads(path.read_text(encoding="utf-8"))
    return {content[CASE]} if CASE in content else set()


READERS = {".csv": _in_table, ".json": _in_json}
