"""The reference tables of the chapter's figures satisfy the chapter's equations, which are written out here."""

import re
from functools import cache

import numpy as np
import pandas as pd
import pytest
from scipy.optimize import brentq, minimize_scalar

from chapter import system_of
from pipeline_trees import ROOT
from vibroimpact.figures import fig10_03, fig10_04, fig10_05, fig10_06, fig10_07, fig10_08, fig10_09, fig10_10
from vibroimpact.figures.plotting import simulated
from vibroimpact.tables import read, select
from vibroimpact.theory.fixed_points.table import fixed_point_table

RHO = 2 * 0.35 / (np.pi * 1.65)
LIMIT = 4 / (4 + np.pi * RHO)
EQUAL = system_of("equal")


@cache
def table(name):
    return read(ROOT / f"figures/{name}.csv")


def sawtooth(tau0, C, theta):
    """Return (10.11), 2/pi C arcsin(cos x), without the arcsine, which loses digits at 1."""
    x = (tau0 - theta + np.pi) % (2 * np.pi) - np.pi
    return C * (1 - 2 / np.pi * np.abs(x))


def B_squared(C):
    return 1 - 2 * C + (1 + RHO**2) * C**2


def test_the_sawtooth_is_10_11_with_impacts_at_its_corners():
    line, impacts = (select(table("fig10_03"), "Z", series) for series in ("Z", "impacts"))
    np.testing.assert_allclose(line["Z"], sawtooth(line["tau0"], 1, 0.8), atol=1e-14)
    np.testing.assert_allclose(impacts["tau0"], 0.8 + np.pi * np.arange(4), rtol=1e-15)
    np.testing.assert_allclose(impacts["Z"], [1, -1, 1, -1], atol=1e-14)
    assert set(impacts["tau0"]) <= set(line["tau0"])


def test_the_manifold_is_10_16_with_branches_that_meet_at_10_26_and_the_dotted_line_at_its_minimum():
    unstable, stable, level = (
        select(table("fig10_04"), "SIM", name) for name in ("SIM unstable", "SIM stable", "B_min")
    )
    for branch in (unstable, stable):
        np.testing.assert_allclose(branch["B"] ** 2, B_squared(branch["C"]), rtol=1e-12)
    assert unstable["C"].iloc[[0, -1]].tolist() == [0, pytest.approx(LIMIT, rel=1e-15)]
    assert stable["C"].iloc[[0, -1]].tolist() == [unstable["C"].iloc[-1], 2.0]
    lowest = minimize_scalar(B_squared)
    np.testing.assert_allclose(level["B"], np.sqrt(lowest.fun), rtol=1e-12)
    fold = fig10_04.key_points(table("fig10_04")).loc["fold (C_min, B_min), (10.25)"]
    np.testing.assert_allclose(fold, [lowest.x, np.sqrt(lowest.fun)], rtol=1e-8)


def test_stability_border_and_fold_have_the_closed_forms_in_kappa():
    stable, unstable, fold = (select(table("fig10_05"), "regions", name) for name in ("stable", "unstable", "C_min"))
    kappa, border = stable["kappa"].iloc[:201], stable["C"].iloc[:201]
    np.testing.assert_allclose(border, (2 + 2 * kappa) / (3 + kappa), rtol=1e-14)  # (10.26) with (10.15) inserted
    rho = 2 * (1 - fold["kappa"]) / (np.pi * (1 + fold["kappa"]))
    np.testing.assert_allclose(fold["C"], 1 / (1 + rho**2), rtol=1e-14)
    assert unstable["C"].iloc[:201].tolist() == border.tolist()
    for outline, C in ((stable, 1.1), (unstable, 0.5)):
        assert outline[["kappa", "C"]].iloc[201:].to_numpy().tolist() == [[1, C], [0, C]]


# Figures 10.6, 10.9 and 10.10: harmonic balance of the boxes with phasors b_i = B_i exp(-i psi_i),
# f_i = z_i b_i - K b_j, where z_i contains the box, the coupling and the first harmonic of the contact force.

FORCING = {"fig10_06": (1.0, 1.0), "fig10_09": (1.0, 0.89), "fig10_10": (0.5, 0.5)}
COUPLING = 1.0 + 0.2j


def impedance(module, C):
    box = [0.0, 0.5][module - 1] - 2 * 0.2 + 0.2j
    return box + COUPLING + 8 / np.pi**2 * (C * (1 - C) + 1j * RHO * C**2) / B_squared(C)


def roots(function, ends, number):
    """Return the zeros of a function between two ends, found by a scan of `number` places."""
    grid = np.linspace(*ends, number)
    values = function(grid)
    return [brentq(function, *grid[k : k + 2], xtol=1e-14) for k in np.flatnonzero(values[1:] * values[:-1] < 0)]


@pytest.mark.parametrize(("name", "number"), [("fig10_06", 3), ("fig10_09", 3), ("fig10_10", 1)])
def test_P_1_and_P_2_are_fixed_points(name, number):
    """A phase difference that balances the force on box 1 balances the force on box 2."""
    points = table(name)
    assert points["series"].isin(["P_1"]).sum() == points["series"].isin(["P_2"]).sum() == number
    on_manifold = points[points["series"].str.match("[PS]_|SIM")]
    np.testing.assert_allclose(on_manifold["B"] ** 2, B_squared(on_manifold["C"]), rtol=1e-12)
    P_1, P_2 = (points.loc[points["series"] == f"P_{i}", ["C", "B"]].to_numpy() for i in (1, 2))
    for (C_1, B_1), (C_2, B_2) in zip(P_1, P_2, strict=True):
        z_1, z_2 = impedance(1, C_1) * B_1, impedance(2, C_2) * B_2

        def first(ahead, z_1=z_1, B_2=B_2):  # b_1 = B_1, b_2 = B_2 exp(i ahead)
            return abs(z_1 - COUPLING * B_2 * np.exp(1j * ahead)) - FORCING[name][0]

        second = [abs(z_2 * np.exp(1j * ahead) - COUPLING * B_1) for ahead in roots(first, (-np.pi, np.pi), 2001)]
        assert np.abs(np.array(second) - FORCING[name][1]).min() < 1e-10


@pytest.mark.parametrize("name", FORCING)
@pytest.mark.parametrize("module", [1, 2])
def test_singular_points_are_all_zeros_of_the_determinant(name, module):
    """The determinant is that of two equations that are linear in cos and sin of psi_2 - psi_1:

    f_i^2 = |z_i|^2 B_i^2 + |K|^2 B_j^2 - 2 B_1 B_2 (Re(z_i K*) cos -+ Im(z_i K*) sin).
    """
    for label in {panel[0] for panel in table(name)["panel"] if len(panel) == 2}:
        fixed_C = select(table(name), f"{label}{3 - module}", f"P_{3 - module}")["C"].item()
        fixed = impedance(3 - module, fixed_C) * np.conj(COUPLING)

        def determinant(C, fixed=fixed):
            return (impedance(module, C) * np.conj(COUPLING) * fixed).imag

        points = (select(table(name), f"{label}{module}", f"S_{module}{beyond}")["C"] for beyond in ("", " beyond"))
        np.testing.assert_allclose(pd.concat(points), roots(determinant, (0, 40), 40_001), rtol=1e-9)


def test_the_caption_states_the_printed_limit_and_the_smaller_C_of_point_b():
    """Point b of the unequal case is stable by the printed limit, and unstable by limits above its smaller C_i."""
    limit, least = re.search(r"C_i = (\d\.\d+)`.* above (\d\.\d+)\.", fig10_09.SPEC["caption"]).groups()
    C = {name: [select(table("fig10_09"), f"{name}{i}", f"P_{i}")["C"].item() for i in (1, 2)] for name in "abc"}
    assert pytest.approx(float(limit), abs=5e-4) == LIMIT < min(C["b"])
    assert min(C["b"]) == pytest.approx(float(least), abs=5e-4)
    assert min(C["a"]) < min(C["b"]) < min(C["c"])


@pytest.mark.parametrize(("name", "draw"), [("fig10_06", fig10_06.draw), ("fig10_09", fig10_09.draw)])
def test_the_heading_of_a_row_contains_the_verdict_of_10_26(name, draw):
    """(10.26) compares the smaller C_i of each point with the limit."""
    smaller = [min(select(table(name), f"{label}{i}", f"P_{i}")["C"].item() for i in (1, 2)) for label in "abc"]
    verdicts = [f"{'stable' if C > LIMIT else 'unstable'} by (10.26)" for C in smaller]
    if name == "fig10_09":
        verdicts[1] = "chapter unstable, (10.26) stable"
    assert [one.get_title("left").split(": ")[1] for one in draw(table(name)).axes[::2]] == verdicts


@pytest.mark.parametrize(("name", "label", "case"), [("fig10_07", "c", "equal"), ("fig10_10", "a", "weak")])
@pytest.mark.parametrize("module", [1, 2])
def test_the_response_is_10_9_and_10_10(name, label, case, module):
    point = fixed_point_table("", system_of(case)).set_index("label").loc[label]
    C, B, psi = point[[f"{quantity}{module}" for quantity in ("C", "B", "psi")]]
    # (10.17): the impact at the wall +1 has the phase theta, with sin and cos of theta + phi as printed
    theta = psi + np.arctan2((1 - C) / B, RHO * C / B)
    lines = {key: select(table(name), f"module {module}", f"{key}_{module}") for key in "UXWY"}
    tau0 = 1.02 * lines["U"]["tau"].to_numpy()
    U = B * np.sin(tau0 - psi)
    W = U + sawtooth(tau0, C, theta)
    for key, value in {"U": U, "W": W, "X": (U + 0.1 * W) / 1.1, "Y": (U - W) / 1.1}.items():
        np.testing.assert_allclose(lines[key]["value"], value, atol=1e-12)


def test_the_modulated_ball_reaches_both_walls_and_does_not_exceed_them():
    assert select(table("fig10_11"), "b", "W_2")["value"].agg(["min", "max"]).tolist() == [-1, 1]


def test_corners_of_the_second_module_are_drawn_at_the_wall():
    samples = pd.DataFrame({"tau": [1.0, 2.0, 3.0], "X2": [0.1, 0.2, 0.3], "Y2": [0.0, -0.5, 0.6]})
    events = [(0.5, 2, 1, 9.0), (1.5, 1, 1, 9.0), (2.0, 2, 1, 0.2), (2.5, 2, -1, 0.25), (3.5, 2, 1, 9.0)]
    drawn = fig10_08.compute(EQUAL, samples, pd.DataFrame(events, columns=["tau", "module", "wall", "X2"]))
    W_2 = select(drawn, "b", "W_2")
    assert W_2[["tau", "value"]].to_numpy().tolist() == [[1, 0.1], [2, 1], [2.5, -1], [3, pytest.approx(-0.3)]]
    assert select(drawn, "a", "X_2")["value"].tolist() == [0.1, 0.2, 0.25, 0.3]
    np.testing.assert_allclose(W_2["cycle"], 1.02 / (2 * np.pi) * W_2["tau"], rtol=1e-12)


def test_intervals_without_resonance_are_those_between_walls_of_more_than_a_cycle():
    """Impacts have known times and walls; after two impacts at the same wall, the interval begins at the first."""
    times, walls = [0.0, 0.5, 1.0, 1.2, 2.3, 2.8, 4.0], [1.0, -1.0, 1.0, 1.0, -1.0, 1.0, -1.0]
    impacts = pd.DataFrame({"panel": "b", "series": "W_2", "cycle": times, "value": walls})
    np.testing.assert_array_equal(simulated.without_resonance(impacts), [[1.0, 2.3], [2.8, 4.0]])


def test_planes_without_fixed_points_show_the_manifold_and_other_planes_contain_all_points():
    points = fixed_point_table("", EQUAL)
    empty = fig10_06.compute(EQUAL, points.iloc[:0], (2.0, 3.5))
    assert set(empty["series"]) == {"SIM stable", "SIM unstable"}
    short = fig10_06.compute(EQUAL, points, 1.2)
    assert short[short["series"] == "SIM stable"].groupby("panel")["C"].max()["a2"] > points["C2"].max()


@pytest.mark.parametrize("ends", [(2.0, 3.5), (3.5, 2.0)])
def test_each_plane_has_its_own_right_end_and_shows_its_whole_manifold(ends):
    planes = fig10_06.draw(fig10_06.compute(EQUAL, fixed_point_table("", EQUAL).iloc[:0], ends)).axes
    assert [axes.get_xlim() for axes in planes] == [(0, end) for end in ends]
    for axes in planes:
        C, B = np.concatenate([line.get_xydata() for line in axes.lines]).T
        assert C.max() == axes.get_xlim()[1]
        assert B.max() < axes.get_ylim()[1]


POINTS = fixed_point_table("", EQUAL)


@pytest.mark.parametrize(
    ("call", "text"),
    [
        (lambda: fig10_03.compute(amplitude=0.0, theta=0.8, tau0_max=12.0), "amplitude"),
        (lambda: fig10_03.compute(amplitude=1.0, theta=0.8, tau0_max=0.5), "tau0_max"),
        (lambda: fig10_04.compute(kappa=0.65, C_max=0.9), "C_max"),
        (lambda: fig10_05.compute((0.7, 1.1)), "C_range"),
        (lambda: fig10_10.compute(EQUAL, POINTS.iloc[:0], "a", 2, 2.0), r"fixed_point: .*'a'.*none"),
        (lambda: fig10_07.compute(EQUAL, POINTS, "a", 0), "periods"),
    ],
)
def test_settings_of_empty_figures_are_refused(call, text):
    with pytest.raises(ValueError, match=text):
        call()
