"""What is the same in a figure and its reference may still be nothing at all."""

import json
import shutil

import numpy as np
import pandas as pd
import pytest

from checking import LIMITS, assert_caught, check_all, page_of
from vibroimpact.figures.kit import tables
from vibroimpact_pipeline.figure_check.compare import check


@pytest.fixture
def both(reference, tmp_path):
    """A folder that is its own reference."""
    for path in reference.glob("fig10_0[45].*"):
        shutil.copy(path, tmp_path)
    return tmp_path


def verdict(folder):
    return check("fig10_04", folder, folder, LIMITS)


def test_a_figure_is_like_itself(both):
    assert verdict(both)["status"] == "passed"


@pytest.mark.parametrize(
    ("change", "said"),
    [
        (lambda table: table.iloc[:0], "fig10_04.csv: no rows"),
        (lambda table: table.assign(B=np.nan), "fig10_04.csv: no value of B"),
        (lambda table: table.assign(B=table["B"].where(table.index > 0, np.inf)), "fig10_04.csv: B is infinite"),
        (lambda table: table.drop(columns=["C", "B"]), "fig10_04.csv: no column of those its card declares: C, B"),
    ],
)
def test_a_table_that_says_nothing_is_a_failure(both, change, said):
    tables.write(change(tables.read(both / "fig10_04.csv")), both / "fig10_04.csv")
    assert_caught(verdict(both), said)


def test_a_series_without_its_values_is_a_failure(both):
    limits = LIMITS | {"columns": {"fig10_04": {"B": {"B_min": "algebra", "others": "algebra"}, "C": "algebra"}}}
    table = tables.read(both / "fig10_04.csv")
    assert check("fig10_04", both, both, limits)["status"] == "passed"
    series = table["series"].iloc[0]
    limits["columns"]["fig10_04"]["B"] = {series: "algebra", "others": "algebra"}
    tables.write(table.assign(B=table["B"].where(table["series"] != series)), both / "fig10_04.csv")
    found = check("fig10_04", both, both, limits)
    assert_caught(found, f"fig10_04.csv: no value of B in series {series}")


def test_a_series_has_its_values_in_any_of_its_panels(both):
    table = tables.read(both / "fig10_04.csv")
    tables.write(pd.concat([table, table.assign(panel="z", B=np.nan)], ignore_index=True), both / "fig10_04.csv")
    series = table["series"].iloc[0]
    limits = LIMITS | {"columns": {"fig10_04": {"B": {series: "algebra", "others": "algebra"}, "C": "algebra"}}}
    assert check("fig10_04", both, both, limits)["reasons"] == []


def test_infinity_passes_where_it_means_something(both):
    table = tables.read(both / "fig10_04.csv")
    tables.write(table.assign(B=table["B"].where(table.index > 0, np.inf)), both / "fig10_04.csv")
    limits = LIMITS | {"infinite": {"fig10_04": {"columns": ["B"]}}}
    assert check("fig10_04", both, both, limits)["status"] == "passed"


def test_a_table_that_the_card_declares_must_be_there(both):
    (both / "fig10_04.csv").unlink()
    assert verdict(both)["reasons"] == ["no reference: fig10_04.csv", "not built: fig10_04.csv"]


def test_a_figure_without_artists_is_a_failure(both):
    path = both / "fig10_04.artists.json"
    content = json.loads(path.read_text())
    empty = {"lines": [], "patches": [], "collections": [], "texts": [], "others": []}
    path.write_text(json.dumps(content | {"axes": [axes | empty for axes in content["axes"]]}))
    assert_caught(verdict(both), "artists: none in any axes")
    path.write_text(json.dumps(content | {"axes": []}))
    assert_caught(verdict(both), "artists: none in any axes")


@pytest.mark.parametrize("content", ["[]", "{}", "null", "7", '"text"', '{"axes": 3}', "[" * 100_000])
@pytest.mark.parametrize("wrong", ["reference", "new", "both"])
def test_json_that_describes_no_figure_fails_its_figure_alone_and_the_page_shows_all(both, tmp_path, content, wrong):
    reference, new = tmp_path / "old", tmp_path / "new"
    for folder in (reference, new):
        folder.mkdir()
        for path in both.glob("fig10_0[45].*"):
            shutil.copy(path, folder)
    for folder, name in ((reference, "reference"), (new, "new")):
        if wrong in (name, "both"):
            (folder / "fig10_04.artists.json").write_text(content)
    verdicts = check_all([], reference, new, LIMITS)
    assert [verdict["status"] for verdict in verdicts] == ["failed", "passed"]
    assert "fig10_05" in page_of(verdicts, reference, new)


def test_without_any_reference_every_figure_fails_by_name(both, tmp_path):
    (found,) = check_all(["fig10_04"], tmp_path / "none", both, LIMITS)
    assert_caught(found, "no reference: fig10_04.png")
