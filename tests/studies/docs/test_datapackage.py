"""The data package: read with nothing else, every table has the columns, types and values that it says."""

import csv
import json
import re
from pathlib import Path

import pandas as pd
import pytest
import yaml

from pipeline_trees import ROOT
from vibroimpact_pipeline.data_dictionary import files, read
from vibroimpact_pipeline.datapackage import data_package
from vibroimpact_pipeline.specs import spec_of


@pytest.fixture(scope="module")
def package(studied):
    return studied / "results", json.loads((studied / "results/datapackage.json").read_text(encoding="utf-8"))


def test_it_has_all_tables_of_a_build_but_those_that_others_gather(package):
    folder, described = package
    gathered = re.compile(
        r"(fixed_points|orbits|verdicts)/\w+\.csv|accuracy/benchmark\.csv|sweeps/\w+/tiles/.*|report/.*"
    )
    tables = {str(path.relative_to(folder)) for path in folder.rglob("*.csv")}
    found = {resource["path"] for resource in described["resources"]}
    assert {path for path in tables if not gathered.fullmatch(path)} <= found <= tables
    assert len(found) > 50


def test_names_are_those_that_the_standard_allows_and_a_schema_is_that_of_its_table(package):
    """Of one table: its columns, with the types and values that they have; those of all are in the data dictionary."""
    folder, described = package
    names = [resource["name"] for resource in described["resources"]]
    assert len(names) == len(set(names))
    assert [name for name in names if not re.fullmatch(r"[a-z0-9._-]+", name)] == []
    [orbits] = [resource["schema"] for resource in described["resources"] if resource["path"] == "orbits.csv"]
    fields, table = {field["name"]: field for field in orbits["fields"]}, pd.read_csv(folder / "orbits.csv")
    assert [*fields] == [*table]
    kinds = {"b": "boolean", "f": "number"}
    types = {name: kinds.get(kind.kind, "string") for name, kind in table.dtypes.items()}
    assert {name: field["type"] for name, field in fields.items()} == types
    assert set(table["exact"]) <= set(fields["exact"]["constraints"]["enum"])
    assert all(field["unit"] and field["unitDescription"] for field in fields.values() if field["type"] == "number")


CITED = {"title": "t", "abstract": "a", "version": 1, "keywords": [], "license": "MIT", "authors": []}


@pytest.mark.parametrize(("name", "column"), [("orbits", "colour"), ("new", "case")])
def test_a_column_that_the_dictionary_lacks_is_refused(name, column):
    specs, data = read(ROOT)
    with pytest.raises(LookupError, match=rf"results/{name}.csv: columns missing in the data dictionary: {column}"):
        data_package({f"results/{name}.csv": ["case", column]}, files(specs, data), data["units"], CITED)


@pytest.mark.parametrize("like", ["fig10_06", "fig10_07", "fig10_08", "fig10_10", "machines"])
def test_tables_of_a_figure_of_ones_own_are_described_as_those_of_the_figure_it_is_drawn_like(studied, like):
    specs, data = read(ROOT)
    scene = {"like": like, "case": "equal", "fixed_point": "b"}
    mine = spec_of("mine", scene, specs)
    headers = {}
    for name, table in specs[like]["tables"].items():
        with open(studied / table["file"], encoding="utf-8", newline="") as file:
            headers[mine["tables"][name]["file"]] = next(csv.reader(file))
    package = data_package(headers, files(specs | {"mine": mine}, data), data["units"], CITED)
    said = {one["path"]: one["description"] for one in package["resources"]}
    assert said.keys() == {path.removeprefix("results/") for path in headers}
    title = f"{mine['own']['title']}."
    assert said["figures/mine.csv"] == title.replace("{case}", "equal").replace("{fixed_point}", "b")


def test_what_it_says_of_the_project_is_what_the_citation_says(package):
    cited = yaml.safe_load(Path(ROOT, "CITATION.cff").read_text(encoding="utf-8"))
    _, described = package
    assert (described["title"], described["version"]) == (cited["title"], cited["version"])
    assert [one["title"] for one in described["contributors"]] == [one["name"] for one in cited["authors"]]
