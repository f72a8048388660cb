"""Test the page of the data dictionary; the tests of the studies compare the dictionary with the files of a build."""

from vibroimpact_pipeline.data_dictionary import files, page, read, stands_for

SPECS, DATA = read()
FILES = files(SPECS, DATA)


def test_the_page_has_every_file_and_column():
    said = page(SPECS, DATA)
    for file in FILES:
        assert all(f"`{path}`" in said for path in file.paths)
        assert all(f"`{name}`" in said for name in file.columns)


def test_a_name_in_braces_stands_for_one_word():
    assert stands_for("results/orbits/{case}.csv", "results/orbits/equal.csv")
    assert stands_for("results/map/{tile}.csv", "results/map/1-of-4.csv")
    assert not stands_for("results/orbits/{case}.csv", "results/orbits/equal.search.csv")
    assert not stands_for("results/{case}.csv", "results/orbits/equal.csv")
    assert not stands_for("results/orbits.csv", "results/orbits_csv")
