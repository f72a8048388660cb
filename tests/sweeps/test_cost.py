"""Measured cost cuts a sweep into tiles; a point where there is no system costs nothing before it is found."""

import pytest
from vibroimpact.sweeps.probe import probe

import vibroimpact as vi
from chapter import PARAMETERS
from vibroimpact.sweeps import probe as probing
from vibroimpact.sweeps.asked import Asked
from vibroimpact.sweeps.cost import MOST_TILES, Cost, tiles
from vibroimpact.sweeps.grid import Grid, axis

BASE = vi.System(**PARAMETERS, f10_hat=1.0, f20_hat=1.0)


def test_what_a_few_points_took_stands_for_all():
    assert Cost(points=100, runs=300, seconds=[1.0, 3.0]).core_seconds == 200.0


@pytest.mark.parametrize(("target", "number"), [(60, 4), (200, 1), (1e9, 1), (0.1, 100), (0, 100)])
def test_tiles_take_about_the_target(target, number):
    assert tiles(Cost(points=100, runs=300, seconds=[2.0]), target) == number


def test_there_are_never_more_tiles_than_a_disk_likes():
    assert tiles(Cost(points=1_000_000, runs=0, seconds=[1.0]), 0) == MOST_TILES


def test_points_are_measured_and_runs_counted():
    grid = Grid(BASE, [axis(["kappa"], [0.5, 0.8], 20)])
    found = probe(grid, Asked(("amplitudes", "fixed_points"), starts=3, seed=1, cycles=4, settle=2))
    assert (found.points, found.runs) == (20, 60)
    assert len(found.seconds) == probing.PROBED
    assert min(found.seconds) >= 0


def test_a_point_without_a_system_is_found_before_anything_is_measured(monkeypatch):
    monkeypatch.setattr(probing, "rows", None)
    with pytest.raises(ValueError, match=r"at kappa = 1: kappa: 1\.0 is not between 0 and 1"):
        probe(Grid(BASE, [axis(["kappa"], [0.5, 1.0], 20)]), Asked(("fixed_points",)))
