"""Points of the sweeps that figures draw as curves, against an integrator that shares nothing with the engine."""

import numpy as np
import pytest
import yaml

import vibroimpact as vi
from pipeline_trees import ROOT
from vibroimpact.regimes.classification import starts
from vibroimpact.rivals import METHODS
from vibroimpact.sweeps.grid import Grid, axis

CONFIG = yaml.safe_load((ROOT / "config/config.yaml").read_text(encoding="utf-8"))
RIVAL = next(method for method in METHODS if method.name == "DOP853")
CYCLES, POINTS = 3, 20


def points(name):
    """Random systems of a sweep, along its band, too, with one of its starts each; from rest an impact may graze."""
    sweep, rng = CONFIG["sweeps"][name], np.random.default_rng(7)
    grid = Grid(vi.System(**CONFIG["system"], f10_hat=1.0, f20_hat=1.0), [axis(**one) for one in sweep["axes"]])
    band = axis(**sweep["band"]).values if "band" in sweep else None
    for number in rng.choice(len(grid), POINTS, replace=len(grid) < POINTS):
        system = grid.system(int(number))
        system = system.with_(sigma_e_hat=float(rng.choice(band))) if band else system
        yield system, starts(sweep["starts"], sweep["seed"])[rng.integers(1, sweep["starts"])]


@pytest.mark.parametrize("name", ["frequency_response", "clearance", "design"])
def test_states_of_random_points_are_those_of_another_integrator(name):
    impacts = 0
    for system, start in points(name):
        ours, theirs = vi.ensemble(system, start, CYCLES), RIVAL.run(system, start, CYCLES, 0.0, 1e-11)
        np.testing.assert_allclose(ours["final"], theirs.final, rtol=0, atol=1e-6)
        impacts += ours["impacts"].sum()
    assert impacts > 2 * POINTS
