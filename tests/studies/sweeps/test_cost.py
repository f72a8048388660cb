"""The predicted cost of a sweep, and the number of tiles."""

import pytest

from chapter import PARAMETERS
from vibroimpact.studies.sweeps.cost import core_seconds, points, tiles
from vibroimpact.studies.sweeps.spec import parsed

SYSTEM = {**PARAMETERS, "f10_hat": 1.0, "f20_hat": 1.0}
SPEC = {"observe": ["amplitudes"], "starts": 2, "seed": 1, "cycles": 4000, "settle": 10}


def request(values, **spec):
    axes = [{"along": ["kappa"], "range": [0.5, 0.8], "values": values}, {"along": ["f10_hat"], "listed": [0.5, 1.0]}]
    return {"system": SYSTEM, "axes": axes, "spec": SPEC | spec}


def test_points_are_those_of_the_grid():
    grid, _ = parsed(request(3))
    assert points(request(3)["axes"]) == len(grid) == 6


def test_the_cost_grows_with_points_starts_and_cycles():
    one = core_seconds(request(10))
    assert core_seconds(request(20)) == pytest.approx(2 * one)
    assert core_seconds(request(10, cycles=40_000, starts=4)) > 10 * one


@pytest.mark.parametrize(("seconds", "number"), [(1e9, 1), (1e-9, 40)])
def test_there_is_at_least_one_tile_and_at_most_one_per_point(seconds, number):
    assert tiles(request(20), seconds) == number


def test_regimes_cost_their_rounds_blocks_and_a_tenth_of_the_retest():
    observation = {"cycles": 100, "rounds": 3, "blocks": 4, "block": 50, "retest": 2000}
    cost = core_seconds(request(3, observe=["regimes"], observation=observation))
    assert cost == pytest.approx(6 * (0.01 + 5e-6 * 2 * (300 + 200 + 200)))
