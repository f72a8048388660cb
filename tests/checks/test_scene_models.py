"""Every figure is computed with the cheapest rung whose error its lines cannot show: errors only, no timings."""

import sys
from pathlib import Path

import numpy as np
import pandas as pd
import pytest

from vibroimpact.checks import scene_models
from vibroimpact.checks.config import case_parameters, parse

ROOT = Path(__file__).parents[2]
sys.path.insert(0, str(ROOT / "workflow/scripts"))


@pytest.fixture(scope="module")
def config():
    return parse((ROOT / "config/config.yaml").read_text(encoding="utf-8"))


@pytest.fixture(scope="module")
def table(config, tmp_path_factory):
    """The table of a small copy of the results: a short modulated window, still past the horizon of float64."""
    import fixed_points
    import scene_models as adapter
    import simulate
    from vibroimpact.figures import tables
    from vibroimpact.system import System

    folder = tmp_path_factory.mktemp("results")
    for name in ("figures", "fixed_points", "simulations"):
        (folder / name).mkdir()
    config["cases"]["weak"]["simulation"] |= {"transient_cycles": 60, "window_cycles": 4, "digits": 60}
    for case, values in config["cases"].items():
        parameters = case_parameters(config, case)
        (folder / f"simulations/{case}").mkdir()
        files = {n: folder / f"simulations/{case}/{n}.csv" for n in ("samples", "events", "strobe")}
        fixed_points.main(case, parameters, folder / f"fixed_points/{case}.csv")
        simulate.main(
            case, parameters, values["simulation"], files | {"summary": folder / f"simulations/{case}/summary.json"}
        )
    figures = {}
    for figure, scene in config["figures"].items():
        if "model" not in scene:
            continue
        parameters = case_parameters(config, scene["case"]) if "case" in scene else config["system"]
        figures[figure] = [scene, parameters]
        drawn = scene_models.DRAWN_BY[figure]
        if scene["model"] == "closed_form":
            names = {"notebook", "model", "parameters"}
            used = {k: v for k, v in scene.items() if k not in names}
            result = drawn.compute(**used, **({"kappa": parameters["kappa"]} if "parameters" in scene else {}))
        elif scene["model"] == "slow_flow":
            points = tables.read(folder / f"fixed_points/{scene['case']}.csv")
            used = {k: v for k, v in scene.items() if k not in {"notebook", "model", "case"}}
            result = drawn.compute(System(**parameters), points, **used)
        else:
            samples, events = (
                tables.read(folder / f"simulations/{scene['case']}/{n}.csv") for n in ("samples", "events")
            )
            result = drawn.compute(samples, events)
        tables.write(result, folder / f"figures/{figure}.csv")
    simulations = {case: values["simulation"] for case, values in config["cases"].items()}
    adapter.main(figures, simulations, folder, 0.0, folder / "scene_models.csv")
    return pd.read_csv(folder / "scene_models.csv")


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
