"""The data dictionary describes the files, columns, values and keys of both builds, and nothing else."""

import json

import pandas as pd
import pytest

from vibroimpact_pipeline.data_dictionary import files, read, stands_for
from vibroimpact_pipeline.specs import each

SPECS, DATA = read()
FILES = files(SPECS, DATA)
PATHS = [path for file in FILES for path in file.paths if path not in file.on_demand]


@pytest.fixture(scope="module")
def made(studied):
    """Return the data files of a build, without copies in the report, by path relative to the checkout."""
    data = [path for path in (studied / "results").rglob("*") if path.suffix in (".csv", ".json")]
    named = {str(path.relative_to(studied.path)): path for path in sorted(data)}
    return {name: path for name, path in named.items() if not name.startswith("results/report/")}


@pytest.fixture(scope="module")
def tables(made):
    """Return each table, as texts, with its description by its path."""
    found = {}
    for name, path in made.items():
        if path.suffix == ".csv":
            table = pd.read_csv(path, dtype=str, keep_default_na=False)
            found[name] = table, next(file for file in FILES if file.has(name))
    return found


def test_the_dictionary_has_exactly_the_files_of_a_build(made):
    assert len(made) > 100
    assert [name for name in made if sum(file.has(name) for file in FILES) != 1] == []
    assert [path for path in PATHS if not any(stands_for(path, name) for name in made)] == []


def test_the_dictionary_has_exactly_the_columns_of_each_table_in_their_order(tables):
    assert len(tables) > 50
    for name, (table, file) in tables.items():
        # Columns of a sweep depend on its observations.
        described = [column for column in file.columns if column in table or not name.startswith("results/sweeps/")]
        assert described == list(table), name


def test_columns_have_the_values_and_units_of_the_dictionary(tables):
    listed = set()
    for name, (table, file) in tables.items():
        for column in table:
            entry, cells = file.columns[column], table.loc[~table[column].isin(["", "-", "NA"]), column]
            if entry.get("values"):
                listed.add((file.paths[0], column))
                assert set(table[column]) <= {*entry["values"], ""}, (name, column)
            if entry["unit"] == "true or false":
                assert set(cells) <= {"True", "False"}, (name, column)
            elif entry["unit"] != "text":
                pd.to_numeric(cells)
    assert len(listed) > 20


def test_every_shared_name_and_unit_is_used():
    shared, entries = each(DATA["shared"]), [item for file in FILES for item in file.columns.items()]
    assert set(shared) == {name for name, entry in entries if entry["meaning"] == shared.get(name, {}).get("meaning")}
    assert set(DATA["units"]) == {entry["unit"] for _, entry in entries}


def at(node, path) -> list:
    """Return the nodes at a path of keys, in which * stands for every entry."""
    nodes = [node]
    for key in path:
        if key == "*":
            nodes = [inner for outer in nodes for inner in (outer if isinstance(outer, list) else outer.values())]
        else:
            nodes = [outer[key] for outer in nodes if key in outer]
    return nodes


@pytest.mark.parametrize(
    "file", [file for file in FILES if file.keys and set(file.paths) - file.on_demand.keys()], ids=lambda f: f.paths[0]
)
def test_the_dictionary_has_exactly_the_keys_of_each_file(made, file):
    data = [json.loads(path.read_text(encoding="utf-8")) for name, path in made.items() if file.has(name)]
    paths = [tuple(key.split(".")) for key in file.keys]
    for above in {path[:-1] for path in paths}:
        found = {key for one in data for node in at(one, above) for key in node}
        assert found == {path[-1] for path in paths if path[:-1] == above}
