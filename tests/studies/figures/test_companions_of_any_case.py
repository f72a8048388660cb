"""Companion figures of systems without the orbits, points or responses that they show are drawn without them."""

import numpy as np
import pandas as pd
import pytest

import vibroimpact as vi
from chapter import PARAMETERS
from vibroimpact.accuracy.verdict_table import NO_ORBIT, fixed_point_rows, orbit_rows
from vibroimpact.figures import fig10_06, fig10_07, fig10_10
from vibroimpact.studies.figures import (
    companion_asymmetric,
    companion_basins,
    companion_branches,
    companion_coupling,
    companion_epsilon,
    companion_response,
)
from vibroimpact.studies.regimes.epsilon_limit import distance_to_orbit
from vibroimpact.studies.sweeps.grid import Grid, axis
from vibroimpact.studies.sweeps.rows import rows
from vibroimpact.studies.sweeps.spec import Spec
from vibroimpact.theory.fixed_points.table import fixed_point_table, labelled_points

STILL = vi.System(**PARAMETERS, f10_hat=0.05, f20_hat=0.0)
"""The forces are too weak for a fixed point, an orbit or an impact."""
UNCOUPLED = PARAMETERS | {"alpha12_hat": 0.0, "gamma12_hat": 0.0}
OBSERVATION = {"cycles": 20, "rounds": 1, "window": 8, "nearness": 0.02, "blocks": 2, "block": 5, "retest": 50}


def test_fixed_points_without_orbits_have_the_verdict_no_orbit():
    system = vi.System(**PARAMETERS, f10_hat=0.5, f20_hat=0.5)
    rows = fixed_point_rows("weak", system, vi.fixed_points(system), orbit_rows("weak", []))
    assert rows[["orbit", "exact"]].to_numpy().tolist() == [["", NO_ORBIT]]


def test_basins_without_an_orbit_are_those_of_boxes_at_rest():
    tables = companion_basins.compute(STILL, "still", 3, OBSERVATION)
    assert tables["orbits"].set_index("series").loc[["shared"]].to_numpy().tolist() == [[0.0] * 8]
    companion_basins.draw(tables)


def test_forces_too_weak_for_a_response_are_drawn_without_one():
    spec = Spec(("amplitudes", "regimes"), 1, 1, 30, 20, observation=OBSERVATION)
    band = {"along": ["sigma_e_hat"], "range": [-1.0, 1.0], "values": 3}
    forces = axis(["f10_hat", "f20_hat"], listed=[0.05, 0.06])
    grids = Grid(STILL, [axis(**band), forces]), Grid(STILL, [forces])
    frequency, force = (pd.DataFrame(rows(grid, spec, range(len(grid)))) for grid in grids)
    tables = companion_response.compute(STILL, frequency, force, band)
    companion_response.draw(tables).draw_without_rendering()


def test_couplings_without_fixed_points_have_no_errors(monkeypatch):
    for name, value in {"ALIKE": {}, "TRIED": (1.0,)}.items():
        monkeypatch.setattr(companion_coupling, name, value)
    tables = companion_coupling.compute({"equal": STILL})
    assert tables["csv"].empty
    assert tables["summary"].set_index("quantity")["value"]["points"] == 0
    companion_coupling.draw(tables)


def test_a_path_without_special_points_has_a_row_none():
    paths = [{"along": [name], "range": [0.01, 0.02]} for name in ("f10_hat", "f20_hat")]
    attractors = {"values": 2, "starts": 1, "seed": 1}
    tables = companion_branches.compute(STILL, paths, 0.1, 1, attractors, OBSERVATION, {})
    assert tables["special_points"][["path", "kind"]].to_numpy().tolist() == [["f10_hat", "none"], ["f20_hat", "none"]]
    companion_branches.draw(tables)


def test_without_fixed_points_or_asymmetric_orbits_the_manifold_is_shown():
    orbits = pd.DataFrame(columns=["case", "label", "symmetric", "C1", "C2"])
    tables = companion_asymmetric.compute({"still": STILL}, orbits, STILL.kappa, [0.1, 0.01], 3, 2.5)
    assert [len(tables[name]) > 0 for name in ("csv", "pairs", "points")] == [True, False, False]
    companion_asymmetric.draw(tables)


@pytest.mark.parametrize(("force", "points"), [(0.05, 0), (0.5, 1)])
def test_no_order_is_fitted_without_a_point_or_to_a_single_epsilon(force, points):
    system = vi.System(**PARAMETERS, f10_hat=force, f20_hat=force)
    tables = companion_epsilon.compute({"weak": system}, [0.1, 0.01], 3, 0.02)
    assert tables["csv"].empty == (points == 0)
    assert tables["orders"].empty
    companion_epsilon.draw(tables)
    with pytest.raises(ValueError, match=r"mixed\.label: .*'c'"):
        companion_epsilon.compute({"weak": system}, [0.01, 0.001], 3, 0.1, mixed={"case": "weak", "label": "c"})


@pytest.mark.parametrize(("forces", "module"), [((2.0, 0.0), 1), ((0.0, 1.4), 2)])
def test_figures_of_a_single_machine_show_one_module_at_rest(forces, module):
    system = vi.System(**UNCOUPLED, f10_hat=forces[0], f20_hat=forces[1])
    points = fixed_point_table("single", system)
    planes = fig10_06.compute(system, points, 2.5)
    assert set(planes["series"]) == {"SIM stable", "SIM unstable", f"P_{module}"}
    assert fig10_06.verdict(planes, "a") == "stable"
    fig10_06.draw(planes)
    response = fig10_07.compute(system, points, "a", 2.0)
    assert not response["value"][response["panel"] == f"module {3 - module}"].any()
    assert np.abs(response["value"][response["series"] == f"W_{module}"]).max() >= 1
    fig10_07.draw(response)
    fig10_10.draw(fig10_10.compute(system, points, "a", 2.0, 2.5))
    found = orbit_rows("single", vi.orbits(system))
    judged = fixed_point_rows("single", system, labelled_points(points), found).iloc[0]
    orbit = found.set_index("label").loc[judged["orbit"]]
    assert (judged["admissible"], judged["exact"]) == (True, orbit["exact"])


def test_fixed_points_of_a_single_machine_are_compared_with_its_orbits():
    """The orbit converges to the fixed point as epsilon falls. The other module does not change the distance."""
    system = vi.System(**UNCOUPLED, f10_hat=2.0, f20_hat=0.0)
    tables = companion_epsilon.compute({"single": system}, [0.1, 0.001], 5, 0.02)
    assert tables["orders"]["order"].to_numpy() == pytest.approx([1, 1, 1, 2], abs=0.02)
    companion_epsilon.draw(tables)
    both = system.with_(f20_hat=1.4)
    alone, together = (distance_to_orbit(one, vi.fixed_points(one)[0]) for one in (system, both))
    np.testing.assert_allclose(alone.offset, together.offset[[0, 2]], atol=1e-9)
    orbits = orbit_rows("single", vi.orbits(system))
    tables = companion_asymmetric.compute({"single": system}, orbits, system.kappa, [0.1, 0.01], 3, 2.5)
    assert len(tables["pairs"])
    companion_asymmetric.draw(tables)
