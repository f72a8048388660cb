"""Every figure is computed with the cheapest level whose error its lines cannot show: errors only, no timings."""

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


def test_the_level_in_use_meets_the_tolerance_and_the_next_cheaper_one_does_not(table):
    for _, levels in table.groupby("figure", sort=False):
        place = int(np.flatnonzero(levels["in_use"])[0])
        assert levels["meets"].iloc[place], levels
        assert not levels["meets"].iloc[:place].any(), levels


def test_the_tolerance_is_what_a_picture_can_show(table):
    assert table["tolerance"].between(1e-3, 1e-2).all()


def test_levels_stand_in_the_order_of_the_hierarchy(table):
    for _, levels in table.groupby("figure"):
        places = [scene_models.HIERARCHY.index(name) for name in levels["level"]]
        assert places == sorted(places)


def test_no_unstable_orbit_is_offered_as_an_observed_motion(table):
    """Case weak has no stable 1:1 orbit: the level fails, it does not fall back on an unstable one."""
    (level,) = table[(table["figure"] == "fig10_11") & (table["level"] == "orbit")].itertuples()
    assert np.isinf(level.error)
    assert level.note == "0 stable orbits"
