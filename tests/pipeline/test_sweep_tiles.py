"""Tiles of a sweep: those of another question, of another cut, or too few are not gathered."""

import pandas as pd
import pytest

from chapter import PARAMETERS
from vibroimpact.figures.kit.tables import write
from vibroimpact.sweeps.request import fingerprint, understood
from vibroimpact.sweeps.rows import columns, rows
from vibroimpact_pipeline.sweeps.tiles import OF, NotOfThisSweep, gathered, is_of, tile_path

REQUEST = {
    "system": {**PARAMETERS, "f10_hat": 1.0, "f20_hat": 1.0},
    "axes": [{"along": ["kappa"], "range": [0.5, 0.7], "values": 5}],
    "asked": {"observe": ["fixed_points"]},
}
FINER = {**REQUEST, "axes": [{"along": ["kappa"], "range": [0.5, 0.7], "values": 9}]}


def tile(folder, request, number, tiles):
    """A tile as its job writes it."""
    grid, asked = understood(request)
    table = pd.DataFrame(rows(grid, asked, grid.tile(number, tiles)), columns=columns(grid, asked))
    table.insert(0, OF, fingerprint(request))
    write(table, folder / f"{number}-of-{tiles}.csv")
    return folder / f"{number}-of-{tiles}.csv"


@pytest.fixture
def two(tmp_path):
    return [tile(tmp_path, REQUEST, number, 2) for number in (1, 2)]


def gather(paths):
    return gathered(paths, fingerprint(REQUEST), understood(REQUEST)[0])


def test_tiles_are_one_table_in_the_order_of_the_points(two):
    table = gather(two[::-1])
    assert table["kappa"].tolist() == pytest.approx([0.5, 0.55, 0.6, 0.65, 0.7])
    assert OF not in table
    assert (table["failed"] == "").all()


def test_a_fingerprint_is_of_all_that_is_asked():
    others = [
        FINER,
        {**REQUEST, "system": {**REQUEST["system"], "epsilon": 0.05}},
        {**REQUEST, "asked": {"observe": ["orbits"]}},
    ]
    assert len({fingerprint(request) for request in [REQUEST, *others]}) == 4


def test_a_tile_of_another_question_is_refused(two, tmp_path):
    tile(tmp_path, FINER, 1, 2)
    with pytest.raises(NotOfThisSweep, match=r"1-of-2\.csv is of a sweep that asked for something else\. Delete it"):
        gather(two)
    assert not is_of(two[0], fingerprint(REQUEST))
    assert is_of(two[1], fingerprint(REQUEST))


def test_a_missing_tile_and_one_of_another_cut_are_refused(two, tmp_path):
    with pytest.raises(NotOfThisSweep, match="3 different points in 3 rows, not 5 once each"):
        gather(two[:1])
    with pytest.raises(NotOfThisSweep, match="not 5 once each"):
        gather([*two, tile(tmp_path, REQUEST, 1, 3)])


def test_what_is_no_tile_is_of_no_sweep(tmp_path):
    assert not is_of(tmp_path / "none.csv", fingerprint(REQUEST))
    (tmp_path / "empty.csv").write_bytes(b"")
    assert not is_of(tmp_path / "empty.csv", fingerprint(REQUEST))
    assert str(tile_path("mine", 1, 3)) == "results/sweeps/mine/tiles/1-of-3.csv"
