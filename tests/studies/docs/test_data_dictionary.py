"""The data dictionary against the files of both builds, both ways: all they hold is said, and nothing else."""

import json

import pytest

import described_data
from described_data import DATA, FILES
from vibroimpact_pipeline.data_dictionary import stands_for
from vibroimpact_pipeline.specs import each

PATHS = [path for file in FILES for path in file.paths if path not in file.on_demand]


@pytest.fixture(scope="module")
def made(studied):
    return described_data.made_by(studied)


def test_every_file_of_a_build_is_in_the_dictionary_once_and_no_other(made):
    assert len(made) > 100
    assert described_data.not_once(made) == {}
    assert [path for path in PATHS if not any(stands_for(path, name) for name in made)] == []


def test_every_column_is_in_the_dictionary_in_its_place_and_no_other(made):
    found, said = described_data.columns(made)
    assert len(found) > 50
    assert found == said


def test_columns_hold_the_values_and_units_that_the_dictionary_says(made):
    number, others = described_data.other_values(made)
    assert others == {}
    assert number > 20
    assert described_data.of_another_unit(made) == []


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


@pytest.mark.parametrize(
    "file", [file for file in FILES if file.keys and set(file.paths) - file.on_demand.keys()], ids=lambda f: f.paths[0]
)
def test_every_key_is_in_the_dictionary_and_no_other(made, file):
    data = [json.loads(path.read_text(encoding="utf-8")) for name, path in made.items() if file.has(name)]
    paths = [tuple(key.split(".")) for key in file.keys]
    for above in {path[:-1] for path in paths}:
        found = {key for one in data for node in at(one, above) for key in node}
        assert found == {path[-1] for path in paths if path[:-1] == above}
