"""Machines in SI units agree with closed forms in SI units and scale with clearance and force."""

import numpy as np
import pytest

from configs import GOOD
from vibroimpact.studies.figures import machines

SCENE = GOOD["machines"]["machines"]
SETTINGS = {name: SCENE[name] for name in ("plant", "clearances", "shown")}
SETTINGS |= {"frequencies": SCENE["frequencies"] | {"values": 5}, "cycles": 250, "settle": 150}


@pytest.fixture(scope="module")
def made():
    """Return the tables of the figure of machines, for SETTINGS."""
    return machines.compute(**SETTINGS)


def velocities(p, hertz):
    """Return complex velocity amplitudes [m/s] of boxes without balls by (10.1) as printed; forces have the phase 0."""
    omega = 2 * np.pi * hertz
    own = [p[f"k{i}"] + p["k12"] + 1j * omega * (p[f"c{i}"] + p["c12"]) - p["M"] * omega**2 for i in (1, 2)]
    link = -p["k12"] - 1j * omega * p["c12"]
    return 1j * omega * np.linalg.solve([[own[0], link], [link, own[1]]], [p["F10"], p["F20"]])


def test_displacement_and_power_without_impacts_are_those_of_the_linear_machines(made):
    line = made["csv"].query("series == 'without balls'")
    for hertz, swing in line[["frequency", "swing"]].to_numpy()[::50]:
        moving = velocities(SCENE["plant"], hertz)
        assert swing == pytest.approx(1000 * abs(moving).max() / (2 * np.pi * hertz), rel=1e-9)
    idle = made["summary"].set_index("L").loc[0.05]
    moving = velocities(SCENE["plant"], idle["frequency"])
    forces = [SCENE["plant"][name] for name in ("F10", "F20")]
    assert idle["power"] == pytest.approx(0.5 * (moving.real @ forces), rel=1e-3)
    assert idle["swing"] == pytest.approx(1000 * abs(moving).max() / (2 * np.pi * idle["frequency"]), rel=1e-3)
    assert idle["share"] == 0


def test_doubling_force_and_clearance_doubles_displacements(made):
    plant = SCENE["plant"] | {name: 2 * SCENE["plant"][name] for name in ("F10", "F20")}
    wider = SETTINGS | {"plant": plant, "clearances": [2 * L for L in SCENE["clearances"]]}
    found = machines.compute(**wider)["summary"]
    scale = {"frequency": 1, "swing": 2, "power": 4, "share": 1, "force": 2}
    for name, factor in scale.items():
        np.testing.assert_allclose(found[name], factor * made["summary"][name], rtol=1e-9)


def test_impacts_are_one_clearance_from_the_middle_of_the_box(made):
    motion = made["motion"]
    hits = motion[motion["at_wall"]]
    np.testing.assert_allclose(np.abs(hits["box"] - hits["ball"]), 1000 * SCENE["shown"]["L"], rtol=1e-9)
    assert motion["time"].is_monotonic_increasing
    assert (np.abs(motion["box"] - motion["ball"]) <= 1000 * SCENE["shown"]["L"] * (1 + 1e-9)).all()
    assert len(hits) > 20


def test_the_figure_labels_every_curve_and_the_best_clearance(made):
    response = machines.draw(made).axes[0]
    names = ", ".join(text.get_text() for text in response.texts).split(", ")
    expected = [f"$L = {1000 * L:g}$ mm" for L in SCENE["clearances"]]
    assert sorted(names) == sorted([*expected, *machines.LINES])
    assert response.get_title("left").endswith(expected[made["summary"]["swing"].to_numpy().argmin()])
