"""The grid of a sweep: values of axes, systems at points, and tiles."""

import pytest

import vibroimpact as vi
from chapter import PARAMETERS
from vibroimpact.studies.sweeps.grid import Grid, axis

BASE = vi.System(**PARAMETERS, f10_hat=1.0, f20_hat=1.0)
TOGETHER = axis(["f10_hat", "f20_hat"], listed=[0.5, 0.8])


def test_values_over_a_range_have_both_ends():
    assert axis(["kappa"], [0.2, 0.8], 4).values == pytest.approx((0.2, 0.4, 0.6, 0.8))
    assert axis(["epsilon"], [0.001, 1], 4, "logarithmic").values == pytest.approx((0.001, 0.01, 0.1, 1))


def test_parameters_of_an_axis_vary_together_and_others_are_constant():
    grid = Grid(BASE, [axis(["kappa"], [0.2, 0.8], 3), TOGETHER])
    assert len(grid) == 6
    assert [grid.place(k)["kappa"] for k in range(6)] == pytest.approx([0.2, 0.2, 0.5, 0.5, 0.8, 0.8])
    assert grid.system(3) == BASE.with_(kappa=0.5, f10_hat=0.8, f20_hat=0.8)


def test_an_error_names_the_point_of_an_invalid_system():
    grid = Grid(BASE, [axis(["sigma_e_hat"], [-20, 0], 2), axis(["epsilon"], listed=[0.01, 0.1])])
    assert grid.system(0).Omega == pytest.approx(0.8)
    with pytest.raises(
        ValueError, match=r"at sigma_e_hat = -20, epsilon = 0.1: sigma_e_hat: the frequency 1 \+ epsilon"
    ):
        grid.system(1)


@pytest.mark.parametrize("tiles", [1, 2, 5, 6])
def test_tiles_have_every_point_once_and_differ_in_size_by_one_at_most(tiles):
    grid = Grid(BASE, [axis(["kappa"], [0.2, 0.8], 3), TOGETHER])
    parts = [list(grid.tile(number, tiles)) for number in range(1, tiles + 1)]
    assert sorted(point for part in parts for point in part) == list(range(6))
    assert max(map(len, parts)) - min(map(len, parts)) <= 1
