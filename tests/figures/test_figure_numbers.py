"""The plotted numbers against values computed here, from the chapter's equations alone."""

import re

import mpmath
import numpy as np
import pandas as pd
import pytest
from scipy.integrate import solve_ivp
from scipy.optimize import brentq, minimize_scalar

from figure_tables import table_of_points, tables_of_run
from vibroimpact.figures import fig10_03, fig10_04, fig10_05, fig10_06, fig10_07, fig10_08, fig10_09, fig10_10
from vibroimpact.figures.plotting import simulated
from vibroimpact.tables import select

KAPPA = mpmath.mpf("0.65")
RHO = 2 * (1 - KAPPA) / (mpmath.pi * (1 + KAPPA))
LIMIT = 4 / (4 + mpmath.pi * RHO)
FIRST_HARMONIC = 8 / np.pi**2


def sawtooth(tau0, C, theta):
    return 2 / mpmath.pi * C * mpmath.asin(mpmath.cos(mpmath.mpf(tau0) - theta))


# Figure 10.3


def test_the_sawtooth_is_10_11(scenes):
    line = select(scenes["fig10_03"].table, "Z", "Z")
    for tau0, Z in line[["tau0", "Z"]].iloc[::17].to_numpy():
        expected = float(sawtooth(tau0, 1, mpmath.mpf(0.8)))
        assert Z == pytest.approx(expected, abs=1e-14)  # noqa: SIM300


def test_impacts_are_half_a_period_apart_at_the_corners(scenes):
    table = scenes["fig10_03"].table
    impacts = select(table, "Z", "impacts")
    np.testing.assert_allclose(impacts["tau0"], 0.8 + np.pi * np.arange(4), rtol=1e-15)
    np.testing.assert_allclose(impacts["Z"], [1, -1, 1, -1], atol=1e-14)
    line = select(table, "Z", "Z")
    assert set(impacts["tau0"]) <= set(line["tau0"])
    slopes = np.diff(line["Z"]) / np.diff(line["tau0"])
    np.testing.assert_allclose(np.abs(slopes), 2 / np.pi, rtol=1e-9)
    assert np.count_nonzero(np.diff(np.sign(slopes))) == len(impacts)
    np.testing.assert_allclose(fig10_03.key_points(table)["after"].iloc[1:], np.pi, rtol=1e-14)


@pytest.mark.parametrize(("changes", "name"), [({"amplitude": 0.0}, "amplitude"), ({"tau0_max": 0.5}, "tau0_max")])
def test_a_sawtooth_that_shows_nothing_is_refused(changes, name):
    with pytest.raises(ValueError, match=name):
        fig10_03.compute(**({"amplitude": 1.0, "theta": 0.8, "tau0_max": 12.0} | changes))


# Figure 10.4


def test_the_manifold_is_10_16(scenes):
    table = scenes["fig10_04"].table
    for series in ("SIM stable", "SIM unstable"):
        for C, B in select(table, "SIM", series)[["C", "B"]].iloc[::23].to_numpy():
            C = mpmath.mpf(C)
            assert float(B) == pytest.approx(float(mpmath.sqrt(1 - 2 * C + (1 + RHO**2) * C**2)), rel=1e-13)


def test_the_branches_meet_at_10_26_and_cover_the_range(scenes):
    table = scenes["fig10_04"].table
    unstable, stable = (select(table, "SIM", f"SIM {name}")["C"] for name in ("unstable", "stable"))
    assert unstable.iloc[0] == 0
    assert unstable.iloc[-1] == stable.iloc[0] == pytest.approx(float(LIMIT), rel=1e-15)
    assert stable.iloc[-1] == 2.0
    assert unstable.is_monotonic_increasing
    assert stable.is_monotonic_increasing
    assert max(np.diff(unstable).max(), np.diff(stable).max()) < 0.006


def test_the_dotted_level_is_the_lowest_point_of_the_manifold(scenes):
    table = scenes["fig10_04"].table
    rho = float(RHO)
    lowest = minimize_scalar(lambda C: 1 - 2 * C + (1 + rho**2) * C**2)
    level = select(table, "SIM", "B_min")
    assert level["C"].tolist() == [0.0, 2.0]
    np.testing.assert_allclose(level["B"], np.sqrt(lowest.fun), rtol=1e-12)
    fold = fig10_04.key_points(table).loc["fold (C_min, B_min), (10.25)"]
    np.testing.assert_allclose(fold, [lowest.x, np.sqrt(lowest.fun)], rtol=1e-8)


def test_a_manifold_without_its_right_arm_is_refused():
    with pytest.raises(ValueError, match="C_max"):
        fig10_04.compute(kappa=0.65, C_max=0.9)


# Figure 10.5


def test_the_border_and_the_fold_over_kappa(scenes):
    table = scenes["fig10_05"].table
    stable, fold = select(table, "regions", "stable"), select(table, "regions", "C_min")
    for row in range(0, 201, 20):
        kappa, border = stable[["kappa", "C"]].iloc[row]
        # (10.26) with (10.15) inserted, in its lowest terms
        assert border == pytest.approx((2 + 2 * kappa) / (3 + kappa), rel=1e-14)
        rho = 2 * (1 - kappa) / (np.pi * (1 + kappa))
        assert fold["C"].iloc[row] == pytest.approx(1 / (1 + rho**2), rel=1e-14)


def test_stable_is_above_the_border_and_unstable_below(scenes):
    table = scenes["fig10_05"].table
    outlines = {name: select(table, "regions", name) for name in ("stable", "unstable")}
    border = outlines["stable"]["C"].iloc[:201].to_numpy()
    assert (outlines["unstable"]["C"].iloc[:201].to_numpy() == border).all()
    assert outlines["stable"].iloc[201:][["kappa", "C"]].to_numpy().tolist() == [[1, 1.1], [0, 1.1]]
    assert outlines["unstable"].iloc[201:][["kappa", "C"]].to_numpy().tolist() == [[1, 0.5], [0, 0.5]]


def test_the_right_arm_is_entirely_stable_and_a_piece_of_the_left_arm_too(scenes):
    points = fig10_05.key_points(scenes["fig10_05"].table)
    assert (points["stable_left_arm"].iloc[:-1] > 0).all()
    assert points["stable_left_arm"].iloc[-1] == pytest.approx(0, abs=1e-15)


def test_a_range_that_cuts_the_border_is_refused():
    with pytest.raises(ValueError, match="C_range"):
        fig10_05.compute((0.7, 1.1))


# Figures 10.6, 10.9 and 10.10: harmonic balance of the boxes, written with phasors b_i = B_i exp(-i psi_i):
# f_i = z_i b_i - K b_j, where z_i holds the box, the coupling and the first harmonic of the ball's reaction.

FORCING = {"fig10_06": (1.0, 1.0), "fig10_09": (1.0, 0.89), "fig10_10": (0.5, 0.5)}
COUPLING = 1.0 + 0.2j


def impedance(module, C):
    rho = float(RHO)
    box = [0.0, 0.5][module - 1] - 2 * 0.2 + 0.2j
    B_squared = 1 - 2 * C + (1 + rho**2) * C**2
    return box + COUPLING + FIRST_HARMONIC * (C * (1 - C) + 1j * rho * C**2) / B_squared


def coordinates(table, series):
    return table.loc[table["series"] == series, ["C", "B"]].to_numpy()


@pytest.mark.parametrize(("name", "number"), [("fig10_06", 3), ("fig10_09", 3), ("fig10_10", 1)])
def test_projections_are_fixed_points(scenes, name, number):
    """At P_1, P_2 both boxes need the given force: the phase difference from one module fits the other."""
    table = scenes[name].table
    P_1, P_2 = coordinates(table, "P_1"), coordinates(table, "P_2")
    assert len(P_1) == len(P_2) == number
    for (C_1, B_1), (C_2, B_2) in zip(P_1, P_2, strict=True):
        z_1, z_2 = impedance(1, C_1), impedance(2, C_2)

        def forces(ahead, z_1=z_1, z_2=z_2, B_1=B_1, B_2=B_2):
            turn = np.exp(1j * ahead)  # b_1 = B_1, b_2 = B_2 turn
            return abs(z_1 * B_1 - COUPLING * B_2 * turn), abs(z_2 * B_2 * turn - COUPLING * B_1)

        grid = np.linspace(-np.pi, np.pi, 2001)
        first = np.array([forces(ahead)[0] for ahead in grid]) - FORCING[name][0]
        roots = [
            brentq(lambda ahead: forces(ahead)[0] - FORCING[name][0], *grid[k : k + 2], xtol=1e-14)
            for k in np.flatnonzero(first[1:] * first[:-1] < 0)
        ]
        assert min(abs(forces(root)[1] - FORCING[name][1]) for root in roots) < 1e-10


@pytest.mark.parametrize("name", ["fig10_06", "fig10_09", "fig10_10"])
@pytest.mark.parametrize("module", [1, 2])
def test_singular_points_are_all_zeros_of_the_determinant(scenes, name, module):
    """sin^2 + cos^2 = 1 for psi_1 and psi_2 gives two equations linear in cos and sin of psi_2 - psi_1:

    f_i^2 = |z_i|^2 B_i^2 + |K|^2 B_j^2 - 2 B_1 B_2 (Re(z_i K*) cos -+ Im(z_i K*) sin).
    """
    table = scenes[name].table
    for label in dict.fromkeys(panel[0] for panel in table["panel"] if panel[-1] == str(module) and len(panel) == 2):
        held_C = select(table, f"{label}{3 - module}", f"P_{3 - module}")["C"].item()
        held = impedance(3 - module, held_C) * np.conj(COUPLING)

        def determinant(C, held=held):
            own = impedance(module, C) * np.conj(COUPLING)
            return np.linalg.det([[own.real, -own.imag], [held.real, held.imag]])

        grid = np.linspace(0, 40, 40_001)
        values = np.array([determinant(C) for C in grid])
        zeros = [brentq(determinant, *grid[k : k + 2]) for k in np.flatnonzero(values[1:] * values[:-1] < 0)]
        found = pd.concat(select(table, f"{label}{module}", f"S_{module}{beyond}")["C"] for beyond in ("", " beyond"))
        np.testing.assert_allclose(found, zeros, rtol=1e-9)


@pytest.mark.parametrize("name", ["fig10_06", "fig10_09", "fig10_10"])
def test_all_points_lie_on_the_manifold(scenes, name):
    table = scenes[name].table
    points = table[table["series"].str.match("[PS]_|SIM")]
    C = points["C"]
    np.testing.assert_allclose(points["B"] ** 2, 1 - 2 * C + (1 + float(RHO) ** 2) * C**2, rtol=1e-12)


def test_the_caption_says_where_point_b_of_the_unequal_case_lies(scenes):
    """On the line that the printed limit calls stable; unstable under limits above its smaller C_i alone."""
    table, caption = scenes["fig10_09"].table, fig10_09.SPEC["caption"]
    limit, least = re.search(r"C_i = (\d\.\d+)`.* above (\d\.\d+)\.", caption).groups()
    C = {label: [select(table, f"{label}{i}", f"P_{i}")["C"].item() for i in (1, 2)] for label in "abc"}
    assert float(LIMIT) == pytest.approx(float(limit), abs=5e-4)
    for i in (1, 2):
        ends = select(table, f"b{i}", "SIM stable")["C"].agg(["min", "max"])
        assert ends["min"] == pytest.approx(float(LIMIT))
        assert ends["min"] < C["b"][i - 1] < ends["max"]
    assert min(C["b"]) == pytest.approx(float(least), abs=5e-4)
    assert min(C["a"]) < min(C["b"]) < min(C["c"])


@pytest.mark.parametrize(
    ("name", "verdicts"),
    [("fig10_06", ["unstable", "stable", "stable"]), ("fig10_09", ["unstable", "stable", "stable"])],
)
def test_the_head_of_a_row_has_the_verdict_of_10_26_on_its_point(scenes, name, verdicts):
    """By the smaller C_i of each point against the limit computed here."""
    table = scenes[name].table
    C = [min(select(table, f"{label}{i}", f"P_{i}")["C"].item() for i in (1, 2)) for label in "abc"]
    assert ["stable" if one > float(LIMIT) else "unstable" for one in C] == verdicts
    axes = {"fig10_06": fig10_06, "fig10_09": fig10_09}[name].draw(table).axes
    heads = [one.get_title("left").split("   ")[1] for one in axes[::2]]
    said = [f"{verdict} by (10.26)" for verdict in verdicts]
    if name == "fig10_09":
        said[1] = "chapter unstable, (10.26) stable"
    assert heads == said
    assert [one.get_title("center").strip() for one in axes[:2]] == ["module 1", "module 2"]
    assert len({one.get_xlim() for one in axes}) == 1


def test_planes_keep_the_order_of_the_labels(scenes):
    panels = list(dict.fromkeys(scenes["fig10_06"].table["panel"]))
    assert panels == ["a1", "a2", "b1", "b2", "c1", "c2"]


def test_planes_without_fixed_points_show_the_manifold(system):
    table = fig10_06.compute(system, table_of_points(system).iloc[:0], (2.0, 3.5))
    assert set(table["series"]) == {"SIM stable", "SIM unstable"}
    assert len(fig10_06.draw(table).axes) == 2


def test_planes_reach_every_fixed_point(system):
    table = fig10_06.compute(system, table_of_points(system), 1.2)
    reach = table[table["series"] == "SIM stable"].groupby("panel")["C"].max()
    assert reach["a2"] > table_of_points(system)["C2"].max()


def test_flights_of_more_than_a_cycle_are_without_resonance():
    """Impacts at known times and walls; a ball that stays at a wall has not reached the other one."""
    times, walls = [0.0, 0.5, 1.0, 1.2, 2.3, 2.8, 4.0], [1, -1, 1, 1, -1, 1, -1]
    table = pd.DataFrame({"panel": "b", "series": "W_2", "cycle": times, "value": np.array(walls, float)})
    np.testing.assert_array_equal(simulated.without_resonance(table), [[1.0, 2.3], [2.8, 4.0]])


# Figures 10.7 and 10.10


@pytest.mark.parametrize(("name", "row"), [("fig10_07", -1), ("fig10_10", 0)])
@pytest.mark.parametrize("module", [1, 2])
def test_the_response_is_10_9_and_10_10(scenes, system, name, row, module):
    system = system if name == "fig10_07" else system.with_(f10_hat=0.5, f20_hat=0.5)
    C, B, psi = table_of_points(system).iloc[row][[f"{quantity}{module}" for quantity in ("C", "B", "psi")]]
    # (10.17): the first ball meets the wall +1 at the phase theta with sin, cos of theta + phi as printed
    theta = psi + mpmath.atan2((1 - C) / B, RHO * C / B)
    table = scenes[name].table
    lines = {key: select(table, f"module {module}", f"{key}_{module}") for key in "UXWY"}
    assert len({tuple(line["tau"]) for line in lines.values()}) == 1
    for index in range(3, len(lines["U"]), 37):
        tau = lines["U"]["tau"].iloc[index]
        U = B * mpmath.sin(mpmath.mpf(1.02) * tau - psi)
        W = U + sawtooth(mpmath.mpf(1.02) * tau, C, theta)
        expected = {"U": U, "W": W, "X": (U + 0.1 * W) / 1.1, "Y": (U - W) / 1.1}
        for key, value in expected.items():
            assert lines[key]["value"].iloc[index] == pytest.approx(float(value), abs=1e-12)


def test_the_ball_of_the_response_hits_the_walls_twice_per_period_as_newton_says(scenes):
    line = select(scenes["fig10_07"].table, "module 2", "W_2")
    tau, W = line["tau"].to_numpy(), line["value"].to_numpy()
    hits = np.flatnonzero(np.isclose(np.abs(W), 1, atol=1e-12))
    np.testing.assert_allclose(np.diff(tau[hits]), np.pi / 1.02, rtol=1e-12)
    assert len(hits) == 4
    slopes = np.diff(W) / np.diff(tau)
    middles = 0.5 * (tau[1:] + tau[:-1])
    for hit in hits:  # slopes extrapolated linearly to the impact from either side
        before = np.polyval(np.polyfit(middles[hit - 3 : hit] - tau[hit], slopes[hit - 3 : hit], 1), 0.0)
        after = np.polyval(np.polyfit(middles[hit : hit + 3] - tau[hit], slopes[hit : hit + 3], 1), 0.0)
        assert after == pytest.approx(-0.65 * before, rel=2e-3)


def test_a_missing_fixed_point_is_named(system):
    with pytest.raises(ValueError, match=r"fixed_point: .*'d'.*a, b, c"):
        fig10_07.compute(system, table_of_points(system), "d", 2)
    with pytest.raises(ValueError, match=r"fixed_point: .*'a'.*none"):
        fig10_10.compute(system, table_of_points(system).iloc[:0], "a", 2, 2.0)


def test_no_periods_are_refused(system):
    with pytest.raises(ValueError, match="periods"):
        fig10_07.compute(system, table_of_points(system), "a", 0)


# Figures 10.8 and 10.11


def test_simulated_lines_agree_with_a_library_integrator(system):
    """(10.2) integrated by DOP853 with its event detection, restarted at every impact."""
    start = np.array([0.2, 0.1, -0.3, 0.2, 0.1, -0.6, 0.2, 0.9])
    table = fig10_08.compute(system, *tables_of_run(system, start, 0, 3, 50))
    end = 3 * system.period
    stiffness, damping = np.array([[1.1, -0.1], [-0.1, 1.15]]), np.array([[0.04, -0.02], [-0.02, 0.04]])

    def rates(tau, s):
        X, V = s[[0, 2]], s[[4, 6]]
        acceleration = 0.1 * np.sin(1.02 * tau) - stiffness @ X - damping @ V
        return [*s[4:], acceleration[0], 0, acceleration[1], 0]

    def wall(module, side):
        def gap(tau, s):
            return side * (s[2 * module] - s[2 * module + 1]) - 1

        gap.terminal, gap.direction = True, 1
        return gap

    walls = [wall(module, side) for module in (0, 1) for side in (1, -1)]
    tau, state, pieces = 0.0, start, []
    while tau < end:
        flight = solve_ivp(
            rates, (tau, end), state, "DOP853", events=walls, rtol=1e-12, atol=1e-13, max_step=0.05, dense_output=True
        )
        pieces.append((tau, flight.t[-1], flight.sol))
        tau, state = flight.t[-1], flight.y[:, -1].copy()
        for event, times in enumerate(flight.t_events):
            if len(times):
                box, ball = 4 + 2 * (event // 2), 5 + 2 * (event // 2)
                momentum, relative = state[box] + 0.1 * state[ball], state[box] - state[ball]
                state[box] = (momentum - 0.1 * 0.65 * relative) / 1.1
                state[ball] = state[box] + 0.65 * relative
    assert len(pieces) > 6
    X_2, W_2 = select(table, "a", "X_2"), select(table, "b", "W_2")
    for index in range(0, len(X_2), 5):
        tau = X_2["tau"].iloc[index]
        s = next(sol(tau) for begin, stop, sol in pieces if begin <= tau <= stop)
        assert X_2["value"].iloc[index] == pytest.approx(s[2], abs=1e-8)
        assert W_2["value"].iloc[index] == pytest.approx(s[2] - s[3], abs=1e-8)


def test_corners_of_the_second_module_are_drawn_at_the_wall(system):
    samples = pd.DataFrame({"tau": [1.0, 2.0, 3.0], "X2": [0.1, 0.2, 0.3], "Y2": [0.0, -0.5, 0.6]})
    events = pd.DataFrame(
        {
            "tau": [0.5, 1.5, 2.0, 2.5, 3.5],
            "module": [2, 1, 2, 2, 2],
            "wall": [1, 1, 1, -1, 1],
            "X2": [9.0, 9.0, 0.2, 0.25, 9.0],
        }
    )
    table = fig10_08.compute(system, samples, events)
    W_2 = select(table, "b", "W_2")
    assert W_2[["tau", "value"]].to_numpy().tolist() == [[1, 0.1], [2, 1], [2.5, -1], [3, pytest.approx(-0.3)]]
    assert select(table, "a", "X_2")["value"].tolist() == [0.1, 0.2, 0.25, 0.3]
    np.testing.assert_allclose(W_2["cycle"], 1.02 / (2 * np.pi) * W_2["tau"], rtol=1e-12)


def test_the_modulated_ball_reaches_both_walls_and_goes_no_further(scenes):
    W_2 = select(scenes["fig10_11"].table, "b", "W_2")["value"]
    assert W_2.abs().max() == 1
    assert W_2.min() == -1
