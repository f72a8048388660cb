"""Test the page of the data dictionary. The tests of the studies compare the dictionary with the files of a build."""

from vibroimpact_pipeline.data_dictionary import files, page, read, stands_for

SPECS, DATA = read()
FILES = files(SPECS, DATA)


def test_the_page_lists_every_file_and_column():
    text = page(SPECS, DATA)
    for file in FILES:
        assert all(f"`{path}`" in text for path in file.paths)
        assert all(f"`{name}`" in text for name in file.columns)


def test_a_name_in_braces_matches_one_part_of_a_file_name():
    assert stands_for("results/orbits/{case}.csv", "results/orbits/equal.csv")
    assert stands_for("results/map/{tile}.csv", "results/map/1-of-4.csv")
    assert not stands_for("results/orbits/{case}.csv", "results/orbits/equal.search.csv")
    assert not stands_for("results/{case}.csv", "results/orbits/equal.csv")
    assert not stands_for("results/orbits.csv", "results/orbits_csv")
