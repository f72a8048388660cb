"""Test that the data dictionary describes exactly the files and columns of the default build."""

import pytest

import described_data
from described_data import DATA, FILES, SPECS
from vibroimpact_pipeline.data_dictionary import page, stands_for


@pytest.fixture(scope="module")
def made(built):
    return described_data.made_by(built)


def test_the_page_has_every_file_and_column():
    said = page(SPECS, DATA)
    for file in FILES:
        assert all(f"`{path}`" in said for path in file.paths)
        assert all(f"`{name}`" in said for name in file.columns)


def test_every_file_of_a_build_is_in_the_dictionary_once(made):
    assert len(made) > 50
    assert described_data.not_once(made) == {}


def test_every_column_is_in_the_dictionary_in_its_place_and_no_other(made):
    found, said = described_data.columns(made)
    assert len(found) > 25
    assert found == said


def test_columns_hold_the_values_and_units_that_the_dictionary_says(made):
    number, others = described_data.other_values(made)
    assert others == {}
    assert number > 10
    assert described_data.of_another_unit(made) == []


def test_every_column_has_a_meaning_and_a_unit_of_the_list():
    for file in FILES:
        for column, entry in file.columns.items():
            assert entry["meaning"], (file.paths, column)
            assert entry["unit"] in DATA["units"], (file.paths, column)


def test_a_name_in_braces_stands_for_one_word():
    assert stands_for("results/orbits/{case}.csv", "results/orbits/equal.csv")
    assert stands_for("results/map/{tile}.csv", "results/map/1-of-4.csv")
    assert not stands_for("results/orbits/{case}.csv", "results/orbits/equal.search.csv")
    assert not stands_for("results/{case}.csv", "results/orbits/equal.csv")
    assert not stands_for("results/orbits.csv", "results/orbits_csv")
