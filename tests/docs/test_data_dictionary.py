"""The data dictionary against the files of a build, both ways: all they hold is said, and nothing else."""

import csv
import json

import pytest

from pipeline_trees import ROOT
from vibroimpact_pipeline.data_dictionary import files, page, read, stands_for
from vibroimpact_pipeline.specs import each

SPECS, DATA = read(ROOT)
FILES = files(SPECS, DATA)
PATHS = [(path, file) for file in FILES for path in file.paths if path not in file.on_demand]
SEPARATORS = {".csv": ",", ".tsv": "\t"}


@pytest.fixture(scope="module")
def made(built):
    """The data of a build, without the report's copies: paths from the checkout."""
    data = [path for path in (built / "results").rglob("*") if path.suffix in (*SEPARATORS, ".json")]
    named = {str(path.relative_to(built.path)): path for path in sorted(data)}
    return {name: path for name, path in named.items() if not name.startswith("results/report/")}


def table(path) -> tuple[list[str], list[dict]]:
    with open(path, encoding="utf-8", newline="") as file:
        lines = (line for line in file if not line.startswith("#"))
        rows = csv.DictReader(lines, delimiter=SEPARATORS[path.suffix])
        return list(rows.fieldnames), list(rows)


def test_the_page_has_every_file_and_column():
    said = page(SPECS, DATA)
    for file in FILES:
        assert all(f"`{path}`" in said for path in file.paths)
        assert all(f"`{name}`" in said for name in file.columns)


def test_every_file_of_a_build_is_in_the_dictionary_once(made):
    assert len(made) > 100
    found = {name: sum(file.has(name) for file in FILES) for name in made}
    assert {name: count for name, count in found.items() if count != 1} == {}


@pytest.mark.parametrize("path", [path for path, _ in PATHS])
def test_every_file_in_the_dictionary_is_one_of_a_build(made, path):
    assert any(stands_for(path, name) for name in made)


def test_every_column_is_in_the_dictionary_in_its_place_and_no_other(made):
    columns = {name: table(path)[0] for name, path in made.items() if path.suffix in SEPARATORS}
    said = {name: list(file.columns) for name in columns for file in FILES if file.has(name)}
    for name in said:
        if name.startswith("results/sweeps/"):  # the columns of what each observes
            said[name] = [column for column in said[name] if column in columns[name]]
    assert len(columns) > 50
    assert columns == said


def test_columns_of_text_say_what_the_dictionary_lists(made):
    listed, found = {}, {}
    for name, path in made.items():
        for file in FILES:
            for column, entry in file.columns.items() if file.has(name) else ():
                if entry.get("values"):
                    key = file.paths[0], column
                    listed[key] = {*entry["values"], ""}
                    found.setdefault(key, set()).update(row[column] for row in table(path)[1])
    assert {key: found[key] - listed[key] for key in listed if not found[key] <= listed[key]} == {}
    assert len(listed) > 20


def unit_of(values) -> str:
    """Text, truth or numbers, as the values of a column are."""
    if values <= {"True", "False"}:
        return "true or false"
    try:
        [float(value) for value in values]
    except ValueError:
        return "text"
    return "numbers"


def test_a_column_holds_what_its_unit_says(made):
    for name, path in made.items():
        rows = table(path)[1] if path.suffix in SEPARATORS else []
        (file,) = (file for file in FILES if file.has(name))
        for column, entry in file.columns.items():
            unit = entry["unit"] if entry["unit"] in ("text", "true or false") else "numbers"
            values = {row[column] for row in rows if column in row} - {"", "-", "NA"}
            assert not values or unit in ("text", unit_of(values)), (name, column)


def test_every_column_has_a_meaning_and_a_unit_of_the_list():
    for file in FILES:
        for column, entry in file.columns.items():
            assert entry["meaning"], (file.paths, column)
            assert entry["unit"] in DATA["units"], (file.paths, column)


def test_every_shared_name_and_unit_is_used():
    shared, entries = each(DATA["shared"]), [item for file in FILES for item in file.columns.items()]
    assert set(shared) == {name for name, entry in entries if entry["meaning"] == shared.get(name, {}).get("meaning")}
    assert set(DATA["units"]) == {entry["unit"] for _, entry in entries}


def at(node, path) -> list:
    """What a path of keys leads to; * stands for every entry."""
    nodes = [node]
    for key in path:
        nodes = [inner for outer in nodes for inner in entries(outer, key)]
    return nodes


def entries(node, key):
    if key == "*":
        return node if isinstance(node, list) else list(node.values())
    return [node[key]] if key in node else []


@pytest.mark.parametrize("file", [file for file in FILES if file.keys and not file.on_demand], ids=lambda f: f.paths[0])
def test_every_key_is_in_the_dictionary_and_no_other(made, file):
    data = [json.loads(path.read_text(encoding="utf-8")) for name, path in made.items() if file.has(name)]
    paths = [tuple(key.split(".")) for key in file.keys]
    for above in {path[:-1] for path in paths}:
        found = {key for one in data for node in at(one, above) for key in node}
        assert found == {path[-1] for path in paths if path[:-1] == above}


def test_a_name_in_braces_stands_for_one_word():
    assert stands_for("results/orbits/{case}.csv", "results/orbits/equal.csv")
    assert stands_for("results/map/{tile}.csv", "results/map/1-of-4.csv")
    assert not stands_for("results/orbits/{case}.csv", "results/orbits/equal.search.csv")
    assert not stands_for("results/{case}.csv", "results/orbits/equal.csv")
    assert not stands_for("results/orbits.csv", "results/orbits_csv")
