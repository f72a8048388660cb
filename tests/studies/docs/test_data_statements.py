"""What the data dictionary says of columns of the studies, computed anew from other columns of a build."""

import numpy as np
import pytest

from chapter import PARAMETERS
from vibroimpact.studies.regimes.classification import REGIMES
from vibroimpact.tables import read

KAPPA = PARAMETERS["kappa"]
RHO = 2 * (1 - KAPPA) / (np.pi * (1 + KAPPA))


@pytest.fixture(scope="module")
def table(studied):
    return lambda name: read(studied / "results" / name)


def columns(table, name, ends=(1, 2)):
    return table[[f"{name}{end}" for end in ends]].to_numpy(float)


def test_criteria_on_the_grid_say_what_their_limits_say(table):
    rows = table("verdict_grid.csv")
    C = columns(rows, "C")
    printed = (4 / (4 + np.pi * RHO) < C).all(axis=1)
    derived = ((C > 1 / (1 + RHO**2)) & (np.pi**2 / (np.pi**2 - 4) > C)).all(axis=1)
    assert ((rows["printed_10_26"] == "stable") == printed).all()
    assert ((rows["fast"] == "stable") == derived).all()


def test_shares_of_regimes_add_up_and_the_map_is_that_of_its_sweep(table):
    shares = table("figures/companion_regime_map.csv")
    both, names = table("sweeps/regime_map.csv"), [*REGIMES]
    np.testing.assert_allclose(shares[names].sum(axis=1), 1.0, atol=1e-12)
    assert (shares["stable_points"] <= shares["fixed_points"]).all()
    assert (both["from_rest"].to_numpy() == shares["label"].to_numpy()).all()
    assert (both[names].to_numpy() == shares[names].to_numpy()).all()
    assert all(both[name][both["from_rest"] == name].gt(0).all() for name in names)


def test_shares_of_basins_are_those_of_the_figure(table):
    starts = table("figures/companion_basins.csv")
    for row in table("regimes/basin_shares.csv").itertuples():
        share = (starts["label"] == row.regime).mean()
        assert row.share == pytest.approx(share, rel=1e-12)
        assert row.uncertainty == pytest.approx(np.sqrt(share * (1 - share) / len(starts)), rel=1e-12)
    assert columns(starts, "W").min() > -1
    assert columns(starts, "W").max() < 1


def test_orders_are_slopes_of_the_curves(table):
    curves = table("figures/companion_epsilon.csv")
    for row in table("regimes/epsilon_orders.csv").itertuples():
        line = curves[(curves["panel"] == row.panel) & (curves["series"] == f"{row.case}, {row.label}")]
        small = line[line["epsilon"] < 0.005]
        slope = np.cov(np.log(small["epsilon"]), np.log(small["error"]))
        assert row.order == pytest.approx(slope[0, 1] / slope[0, 0], rel=1e-9)


def test_limits_in_the_companions_are_those_named(table):
    regions = table("figures/companion_10_05.csv").groupby("series")
    kappa, C = (regions.get_group("symmetry breaking")[name] for name in ("kappa", "C"))
    assert C.to_numpy() == pytest.approx(np.pi**2 / (np.pi**2 - 4))
    fold = regions.get_group("fold")
    rho = 2 * (1 - fold["kappa"]) / (np.pi * (1 + fold["kappa"]))
    np.testing.assert_allclose(fold["C"], 1 / (1 + rho**2), rtol=1e-12)
    assert len(kappa) == len(fold)
