"""The data dictionary: contents of every results file, from the figures' SPECs and report/data.yaml."""

import re
from dataclasses import dataclass, field
from itertools import groupby
from pathlib import Path

import yaml

from vibroimpact_pipeline.specs import columns, each, specs

DATA = "report/data.yaml"
DRAWN = "results/figures/"
LABEL = "data-"
"""Begins the name of a table's place on the pages of data."""


@dataclass(frozen=True)
class File:
    """One kind of results file.

    paths: where such files are; {case} and the like stand for a word. about: what they hold. columns: meaning, unit and
    maybe values of each column, by name; own: names of those whose meaning is not shared. keys: meaning by the path of
    the key, with * for every entry. on_demand: the command by path, for what a plain build leaves alone.
    """

    paths: list[str]
    about: str
    columns: dict[str, dict] = field(default_factory=dict)
    own: list[str] = field(default_factory=list)
    keys: dict[str, str] = field(default_factory=dict)
    on_demand: dict[str, str] = field(default_factory=dict)

    def has(self, path: str) -> bool:
        """Return True if a path relative to the checkout is one of these files."""
        return any(stands_for(pattern, path) for pattern in self.paths)


def stands_for(pattern: str, path: str) -> bool:
    """Return True if a pattern with {words} matches a path."""
    return re.fullmatch(r"[\w-]+".join(map(re.escape, re.split(r"\{\w+\}", pattern))), path) is not None


def read(root) -> tuple[dict, dict]:
    """Read the SPEC of every figure and report/data.yaml."""
    checkout = root if Path(root, "src").is_dir() else None
    return specs(checkout), yaml.safe_load(Path(root, DATA).read_text(encoding="utf-8"))


def files(known: dict, data: dict) -> list[File]:
    """Return all kinds of files, those of figures first; `known` is the SPEC of each figure."""
    shared = each(data["shared"])
    tables = [table for spec in known.values() for table in spec.get("tables", {}).values()]
    found = []
    for entry in [{**table, "files": [table["file"]]} for table in tables] + data["files"]:
        listed = each(entry.get("columns", {}))
        own = [name for name, entry in listed.items() if name not in shared or entry.keys() - {"compared", "infinite"}]
        known_columns, keys = columns({"columns": listed}, shared), each(entry.get("keys", {}))
        found.append(File(entry["files"], entry["about"], known_columns, own, keys, entry.get("on_demand", {})))
    return found


def page(known: dict, data: dict, of_figures: bool | None = None) -> str:
    """Return the data dictionary as Markdown, without its heading; by `of_figures` one part of its files only."""
    parts = [
        "## Units",
        _table(["unit", "meaning"], data["units"].items()),
        "## Names that mean the same in every file",
        _columns(each(data["shared"])),
    ]
    listed = [file for file in files(known, data) if of_figures in (None, file.paths[0].startswith(DRAWN))]
    parts = [*([] if of_figures else parts), "## Files", *(part for file in listed for part in _section(file))]
    return "\n\n".join(parts) + "\n"


def _section(file):
    """Return one section: heading, path and content of the file, names of the shared columns, table of the others."""
    on_demand = {path: f" (made by `{command}`)" for path, command in file.on_demand.items()}
    places = [f"`{path}`{on_demand.get(path, '')}" for path in file.paths]
    common = [f"`{name}`" for name in file.columns if name not in file.own]
    path = file.paths[0]
    place = f"({LABEL}{Path(path).stem.replace('_', '-')})=\n" if path.endswith(".csv") and "{" not in path else ""
    yield f"{place}### {path.removeprefix('results/')}"
    yield f"{', '.join(places)}: {file.about}"
    if common:
        yield f"Shared names: {', '.join(common)}."
    if file.own:
        yield _columns({name: file.columns[name] for name in file.own})
    if file.keys:
        yield _table(["key", "meaning"], ((f"`{key}`", meaning) for key, meaning in file.keys.items()))


def _columns(listed):
    rows = ((f"`{name}`", _meaning(entry), entry["unit"]) for name, entry in listed.items())
    return _table(["column", "meaning", "unit"], rows)


def _meaning(entry):
    """Return the meaning of a column, with its allowed values unless the meaning names them."""
    meaning, values = entry["meaning"], entry.get("values", [])
    return meaning if all(value in meaning for value in values) else f"{meaning}: {'; '.join(values)}"


def _table(heads, rows):
    """Return a pipe table with one row for all names of the same meaning."""
    merged = ((", ".join(name for name, *_ in same), *rest) for rest, same in groupby(rows, lambda row: row[1:]))
    lines = [heads, ["---"] * len(heads), *merged]
    return "\n".join("| " + " | ".join(line) + " |" for line in lines)
