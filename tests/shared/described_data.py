"""Compare the files of a build with the data dictionary."""

import csv
from pathlib import Path

from pipeline_trees import ROOT, Tree
from vibroimpact_pipeline.data_dictionary import files, read

SPECS, DATA = read(ROOT)
FILES = files(SPECS, DATA)
SEPARATORS = {".csv": ",", ".tsv": "\t"}


def made_by(tree: Tree) -> dict[str, Path]:
    """Return the data files of a build, without copies in the report, by path relative to the checkout."""
    data = [path for path in (tree / "results").rglob("*") if path.suffix in (*SEPARATORS, ".json")]
    named = {str(path.relative_to(tree.path)): path for path in sorted(data)}
    return {name: path for name, path in named.items() if not name.startswith("results/report/")}


def table(path) -> tuple[list[str], list[dict]]:
    """Return the header and the rows of a table."""
    with open(path, encoding="utf-8", newline="") as file:
        lines = (line for line in file if not line.startswith("#"))
        rows = csv.DictReader(lines, delimiter=SEPARATORS[path.suffix])
        return list(rows.fieldnames), list(rows)


def not_once(made: dict[str, Path]) -> dict[str, int]:
    """Return the files that the dictionary does not describe exactly once, with the number of descriptions."""
    found = {name: sum(file.has(name) for file in FILES) for name in made}
    return {name: count for name, count in found.items() if count != 1}


def columns(made: dict[str, Path]) -> tuple[dict, dict]:
    """Return, for each table, the columns in the file, and the columns in the dictionary."""
    found = {name: table(path)[0] for name, path in made.items() if path.suffix in SEPARATORS}
    said = {name: list(file.columns) for name in found for file in FILES if file.has(name)}
    for name in said:
        if name.startswith("results/sweeps/"):  # columns depend on the observations of the sweep
            said[name] = [column for column in said[name] if column in found[name]]
    return found, said


def other_values(made: dict[str, Path]) -> tuple[int, dict]:
    """Return the number of columns with listed values, and the values in these columns that are not listed."""
    listed, found = {}, {}
    for name, path in made.items():
        for file in FILES:
            for column, entry in file.columns.items() if file.has(name) else ():
                if entry.get("values"):
                    key = file.paths[0], column
                    listed[key] = {*entry["values"], ""}
                    found.setdefault(key, set()).update(row[column] for row in table(path)[1])
    return len(listed), {key: found[key] - listed[key] for key in listed if not found[key] <= listed[key]}


def of_another_unit(made: dict[str, Path]) -> list[tuple[str, str]]:
    """Return the columns whose values do not fit the unit."""
    found = []
    for name, path in made.items():
        rows = table(path)[1] if path.suffix in SEPARATORS else []
        (file,) = (file for file in FILES if file.has(name))
        for column, entry in file.columns.items():
            unit = entry["unit"] if entry["unit"] in ("text", "true or false") else "numbers"
            values = {row[column] for row in rows if column in row} - {"", "-", "NA"}
            if values and unit not in ("text", _unit_of(values)):
                found.append((name, column))
    return found


def _unit_of(values) -> str:
    """Return whether the values of a column are text, truth values or numbers."""
    if values <= {"True", "False"}:
        return "true or false"
    try:
        [float(value) for value in values]
    except ValueError:
        return "text"
    return "numbers"
