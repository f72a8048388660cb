"""Data dictionary: describe the content of every results file.

The descriptions come from report/data.yaml and from the SPEC (description) of each figure.
"""

import re
from dataclasses import dataclass, field
from itertools import groupby
from pathlib import Path

import yaml

from vibroimpact_pipeline.code import ROOT
from vibroimpact_pipeline.specs import columns, each, specs

DATA = "report/data.yaml"
DRAWN = "results/figures/"
LABEL = "data-"
"""Prefix of the anchor of each table on the data pages."""


@dataclass(frozen=True)
class File:
    """Description of one kind of results file.

    Parameters
    ----------
    paths
        Paths of the files. A placeholder such as {case} stands for one word.
    about
        Content of the files.
    columns
        Description of each column by name: its meaning and unit, and sometimes the allowed values.
    specific
        Names of the columns whose meaning or values apply only to these files.
    keys
        Meaning of each key of a JSON file by key path. In a key path, * stands for every entry.
    on_demand
        For files that the default build does not make: the commands that make the files, by path.
    """

    paths: list[str]
    about: str
    columns: dict[str, dict] = field(default_factory=dict)
    specific: list[str] = field(default_factory=list)
    keys: dict[str, str] = field(default_factory=dict)
    on_demand: dict[str, str] = field(default_factory=dict)

    def has(self, path: str) -> bool:
        """Return True if a path relative to the checkout matches one of `paths`."""
        return any(stands_for(pattern, path) for pattern in self.paths)


def stands_for(pattern: str, path: str) -> bool:
    """Return True if a pattern with placeholders such as {case} matches a path."""
    return re.fullmatch(r"[\w-]+".join(map(re.escape, re.split(r"\{\w+\}", pattern))), path) is not None


def read() -> tuple[dict, dict]:
    """Return the SPEC (description) of every figure by name, and the content of report/data.yaml."""
    return specs(), yaml.safe_load((ROOT / DATA).read_text(encoding="utf-8"))


def files(known: dict, data: dict) -> list[File]:
    """Return a description of each kind of results file.

    The arguments are the values that `read` returns.
    """
    shared = each(data["shared"])
    tables = [table for spec in known.values() for table in spec.get("tables", {}).values()]
    found = []
    for entry in [{**table, "files": [table["file"]]} for table in tables] + data["files"]:
        listed = each(entry.get("columns", {}))
        specific = [
            name for name, entry in listed.items() if name not in shared or entry.keys() - {"compared", "infinite"}
        ]
        known_columns, keys = columns({"columns": listed}, shared), each(entry.get("keys", {}))
        found.append(File(entry["files"], entry["about"], known_columns, specific, keys, entry.get("on_demand", {})))
    return found


def page(known: dict, data: dict, of_figures: bool | None = None) -> str:
    """Return the data dictionary in Markdown.

    `of_figures` selects tables of figures (True), other files (False) or all files (None).
    """
    parts = []
    if not of_figures:
        parts += ["## Units", _table(["unit", "meaning"], data["units"].items())]
        parts += ["## Columns with the same meaning in every file", _columns(each(data["shared"]))]
    listed = [file for file in files(known, data) if of_figures in (None, file.paths[0].startswith(DRAWN))]
    parts += ["## Files", *(part for file in listed for part in _section(file))]
    return "\n\n".join(parts) + "\n"


def _section(file):
    """Yield the parts of a section on a file: heading, paths and description, shared columns, other columns, keys."""
    on_demand = {path: f" (made by `{command}`)" for path, command in file.on_demand.items()}
    places = [f"`{path}`{on_demand.get(path, '')}" for path in file.paths]
    common = [f"`{name}`" for name in file.columns if name not in file.specific]
    path = file.paths[0]
    place = f"({LABEL}{Path(path).stem.replace('_', '-')})=\n" if path.endswith(".csv") and "{" not in path else ""
    yield f"{place}### {path.removeprefix('results/')}"
    yield f"{', '.join(places)}: {file.about}"
    if common:
        yield f"Shared columns: {', '.join(common)}."
    if file.specific:
        yield _columns({name: file.columns[name] for name in file.specific})
    if file.keys:
        yield _table(["key", "meaning"], ((f"`{key}`", meaning) for key, meaning in file.keys.items()))


def _columns(listed):
    rows = []
    for name, entry in listed.items():
        meaning, values = entry["meaning"], entry.get("values", [])
        if not all(value in meaning for value in values):
            meaning += f": {'; '.join(values)}"
        rows.append((f"`{name}`", meaning, entry["unit"]))
    return _table(["column", "meaning", "unit"], rows)


def _table(heads, rows):
    """Return a Markdown table; consecutive rows that differ only in the first cell are merged into one row."""
    merged = ((", ".join(name for name, *_ in same), *rest) for rest, same in groupby(rows, lambda row: row[1:]))
    lines = [heads, ["---"] * len(heads), *merged]
    return "\n".join("| " + " | ".join(line) + " |" for line in lines)
