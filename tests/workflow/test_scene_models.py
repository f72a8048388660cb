"""Every figure is computed with the cheapest rung whose error its lines cannot show: errors only, no timings."""

import numpy as np
import pandas as pd
import pytest

from vibroimpact.accuracy import scene_models


@pytest.fixture(scope="module")
def table(built):
    return pd.read_csv(built / "results/accuracy/scene_models.csv")


def test_every_figure_with_numbers_is_there(table):
    assert sorted(table["figure"].unique()) == [f"fig10_{n:02d}" for n in range(3, 12)]
    assert (table.groupby("figure")["in_use"].sum() == 1).all()


def test_the_rung_in_use_meets_the_tolerance_and_the_next_cheaper_one_does_not(table):
    for _, rungs in table.groupby("figure", sort=False):
        place = int(np.flatnonzero(rungs["in_use"])[0])
        assert rungs["meets"].iloc[place], rungs
        assert not rungs["meets"].iloc[:place].any(), rungs


def test_the_tolerance_is_what_a_picture_can_show(table):
    assert table["tolerance"].between(1e-3, 1e-2).all()


def test_rungs_stand_in_the_order_of_the_ladder(table):
    for _, rungs in table.groupby("figure"):
        places = [scene_models.LADDER.index(name) for name in rungs["rung"]]
        assert places == sorted(places)


def test_no_unstable_orbit_is_offered_as_an_observed_motion(table):
    """Case weak has no stable 1:1 orbit: the rung fails, it does not fall back on an unstable one."""
    (rung,) = table[(table["figure"] == "fig10_11") & (table["rung"] == "orbit")].itertuples()
    assert np.isinf(rung.error)
    assert rung.note == "0 stable orbits"
