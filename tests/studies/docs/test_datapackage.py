"""The data package: read with nothing else, every table has the columns, types and values that it says."""

import csv
import json
import re
from pathlib import Path

import pytest
import yaml

from pipeline_trees import ROOT
from vibroimpact_pipeline.data_dictionary import files, read
from vibroimpact_pipeline.datapackage import data_package
from vibroimpact_pipeline.specs import spec_of


@pytest.fixture(scope="module")
def package(studied):
    return studied / "results", json.loads((studied / "results/datapackage.json").read_text(encoding="utf-8"))


def problems(folder, resource) -> list[str]:
    """What a table has that its schema does not allow, as Table Schema says: headers, types, allowed values."""
    schema = resource["schema"]
    with open(folder / resource["path"], encoding=resource["encoding"], newline="") as table:
        header, *rows = csv.reader(table)
    names = [field["name"] for field in schema["fields"]]
    if header != names:
        return [f"columns {header}, not {names}"]
    found = []
    for field, cells in zip(schema["fields"], zip(*rows, strict=True), strict=True):
        for cell in set(cells) - set(schema["missingValues"]):
            if not fits(cell, field):
                found.append(f"{field['name']}: {cell!r}")
    return found


def fits(cell, field) -> bool:
    if cell not in field.get("constraints", {}).get("enum", [cell]):
        return False
    if field["type"] == "boolean":
        return cell in field["trueValues"] + field["falseValues"]
    if field["type"] == "number":
        try:
            float(cell)
        except ValueError:
            return False
        return True
    return field["type"] == "string"


def test_every_table_is_as_its_schema_says(package):
    folder, described = package
    assert {resource["path"]: problems(folder, resource) for resource in described["resources"]} == {
        resource["path"]: [] for resource in described["resources"]
    }


def test_a_table_with_another_column_type_or_value_is_not(package, tmp_path):
    folder, described = package
    [orbits] = [resource for resource in described["resources"] if resource["path"] == "orbits.csv"]
    text = (folder / "orbits.csv").read_text(encoding="utf-8")
    for old, new, said in (
        ("symmetric", "even", "columns"),
        ("True", "yes", "symmetric"),
        ("equal,S1", "equal,S1x", None),
    ):
        (tmp_path / "orbits.csv").write_text(text.replace(old, new, 1), encoding="utf-8")
        assert "".join(problems(tmp_path, orbits)).startswith(said or "")
    (tmp_path / "orbits.csv").write_text(re.sub(r"-1\.08\d+", "one", text, count=1), encoding="utf-8")
    assert problems(tmp_path, orbits) == ["C1: 'one'"]


def test_it_has_all_tables_of_a_build_but_those_that_others_gather(package):
    folder, described = package
    gathered = re.compile(
        r"(fixed_points|orbits|verdicts)/\w+\.csv|accuracy/benchmark\.csv|"
        r"sweeps/\w+/tiles/.*|(report|force_sweep)/.*"
    )
    tables = {str(path.relative_to(folder)) for path in folder.rglob("*.csv")}
    found = [resource["path"] for resource in described["resources"]]
    assert {path for path in tables if not gathered.fullmatch(path)} <= {*found} <= tables
    assert len(found) > 50


def test_names_are_those_that_the_standard_allows_and_no_field_lacks_a_meaning_or_unit(package):
    _, described = package
    names = [resource["name"] for resource in described["resources"]]
    assert len(names) == len(set(names))
    assert [name for name in names if not re.fullmatch(r"[a-z0-9._-]+", name)] == []
    for resource in described["resources"]:
        assert resource["description"]
        for field in resource["schema"]["fields"]:
            assert field["description"]
            assert field["type"] != "number" or (field["unit"] and field["unitDescription"])


def test_a_column_that_the_dictionary_lacks_is_refused():
    specs, data = read(ROOT)
    cited = {"title": "t", "abstract": "a", "version": 1, "keywords": [], "license": "MIT", "authors": []}
    with pytest.raises(LookupError, match=r"results/orbits.csv: columns missing in the data dictionary: colour"):
        data_package({"results/orbits.csv": ["case", "colour"]}, files(specs, data), data["units"], cited)
    with pytest.raises(LookupError, match=r"results/new.csv: columns missing in the data dictionary: case"):
        data_package({"results/new.csv": ["case"]}, files(specs, data), data["units"], cited)


@pytest.mark.parametrize("like", ["fig10_06", "fig10_07", "fig10_08", "fig10_10", "machines"])
def test_tables_of_a_figure_of_ones_own_are_described_as_those_of_the_figure_it_is_drawn_like(studied, like):
    specs, data = read(ROOT)
    scene = {"like": like, "case": "equal", "fixed_point": "b"}
    mine = spec_of("mine", scene, specs)
    headers = {}
    for name, table in specs[like]["tables"].items():
        with open(studied / table["file"], encoding="utf-8", newline="") as file:
            headers[mine["tables"][name]["file"]] = next(csv.reader(file))
    cited = {"title": "t", "abstract": "a", "version": 1, "keywords": [], "license": "MIT", "authors": []}
    package = data_package(headers, files(specs | {"mine": mine}, data), data["units"], cited)
    assert {resource["path"] for resource in package["resources"]} == {
        path.removeprefix("results/") for path in headers
    }
    [plotted] = [one["description"] for one in package["resources"] if one["path"] == "figures/mine.csv"]
    assert plotted == f"{mine['own']['title']}.".replace("{case}", "equal").replace("{fixed_point}", "b")


def test_what_it_says_of_the_project_is_what_the_citation_says(package):
    cited = yaml.safe_load(Path(ROOT, "CITATION.cff").read_text(encoding="utf-8"))
    _, described = package
    assert (described["title"], described["version"]) == (cited["title"], cited["version"])
    assert [one["title"] for one in described["contributors"]] == [one["name"] for one in cited["authors"]]
