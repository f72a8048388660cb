"""Companion figures: numbers against theory recomputed here, lines and markers as captions say, fit for print."""

import itertools

import matplotlib.colors
import numpy as np
import pandas as pd
import pytest
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.text import Text

import vibroimpact as vi
from chapter import FORCES, PARAMETERS
from verdict_tables import verdicts_of
from vibroimpact.claims.verdict_table import CRITERIA, NO_ORBIT, fixed_point_rows, orbit_rows
from vibroimpact.exact.orbits.search import half_period_multipliers, orbits
from vibroimpact.exact.orbits.symmetric import symmetric_solutions
from vibroimpact.figures import companion_10_04, companion_10_05, companion_stability
from vibroimpact.figures.kit.tables import read, select, write

SYSTEMS = {case: vi.System(**PARAMETERS, f10_hat=f10, f20_hat=f20) for case, (f10, f20) in FORCES.items()}
RHO = 14 / (33 * np.pi)
FOLD, PRINTED, BREAKING = 1 / (1 + RHO**2), 3.3 / 3.65, np.pi**2 / (np.pi**2 - 4)
COMPANIONS = ["companion_10_04", "companion_10_05", "companion_stability"]


@pytest.fixture(scope="module")
def verdict_tables():
    return verdicts_of(SYSTEMS)


@pytest.fixture(scope="module")
def tables(verdict_tables):
    return {
        "companion_10_04": companion_10_04.compute(0.65, 2.5),
        "companion_10_05": companion_10_05.compute((0.5, 2.2)),
        "companion_stability": companion_stability.compute(SYSTEMS, *verdict_tables),
    }


@pytest.fixture(scope="module")
def companions(tables):
    modules = (companion_10_04, companion_10_05, companion_stability)
    figures = {name: module.draw(tables[name]) for name, module in zip(COMPANIONS, modules, strict=True)}
    for figure in figures.values():
        figure.draw_without_rendering()
    return figures


# The tables of verdicts


def test_each_fixed_point_goes_with_the_orbit_that_continues_it(verdict_tables):
    """Followed from small epsilon in steps, instead of taking the nearest at once."""
    points, exact = verdict_tables
    for _, row in points.iterrows():
        C = row[["C1", "C2"]].to_numpy(float)
        for epsilon in np.linspace(0.002, 0.1, 50):
            listed = symmetric_solutions(SYSTEMS[row["case"]].with_(epsilon=epsilon))[:, 2:]
            step = np.abs(listed - C).max(axis=1)
            assert step.min() < 0.01
            C = listed[step.argmin()]
        found = exact[(exact["case"] == row["case"]) & (exact["label"] == row["orbit"])]
        np.testing.assert_allclose(found[["C1", "C2"]].to_numpy()[0], C, atol=1e-8)
        assert row["floquet"] == found["floquet"].iloc[0]


def test_what_is_true_of_the_chapter_s_responses(verdict_tables):
    """No symmetric response of the three cases is stable at epsilon = 0.1; one asymmetric pair is, in two of them."""
    points, exact = verdict_tables
    assert set(points["floquet"]) == {"unstable"}
    stable = exact[exact["floquet"] == "stable"]
    assert not stable["symmetric"].any()
    assert stable.groupby("case").size().to_dict() == {"equal": 2, "unequal": 2}
    assert stable["admissible"].all()


def test_point_c_of_the_equal_case_breaks_symmetry_though_the_theory_calls_it_stable(verdict_tables):
    points, exact = verdict_tables
    (c,) = points[(points["case"] == "equal") & (points["label"] == "c")].to_dict("records")
    assert (c["printed_10_26"], c["masri_derived"], c["slow_flow"]) == ("stable",) * 3
    place = exact[exact["case"] == "equal"]["label"].tolist().index(c["orbit"])
    half = half_period_multipliers(orbits(SYSTEMS["equal"])[place])
    outside = half[np.abs(half) > 1]
    assert len(outside) == 1
    assert outside[0].real < -1.5
    small = SYSTEMS["equal"].with_(epsilon=0.002)
    nearest = min((o for o in orbits(small) if o.symmetric), key=lambda o: np.abs(o.C - [c["C1"], c["C2"]]).max())
    assert np.abs(nearest.multipliers).max() < 1


def test_without_orbits_fixed_points_are_left_without_multipliers(verdict_tables):
    system = SYSTEMS["weak"]
    nothing = orbit_rows("weak", [])
    (row,) = fixed_point_rows("weak", system, zip("a", vi.fixed_points(system), strict=True), nothing).to_dict(
        "records"
    )
    assert (row["orbit"], row["floquet"]) == ("", NO_ORBIT)
    table = companion_stability.compute(
        {"weak": system}, pd.DataFrame([row]), nothing.astype({"symmetric": bool, "admissible": bool})
    )
    companion_stability.draw(table)


def test_no_two_fixed_points_share_an_orbit(verdict_tables):
    points, _ = verdict_tables
    assert not points[["case", "orbit"]].duplicated().any()


# Numbers


def test_pieces_of_the_manifold(tables):
    table = tables["companion_10_04"]
    ends = {"SIM left": (0, FOLD), "SIM stable": (FOLD, BREAKING), "SIM right": (BREAKING, 2.5)}
    for series, (low, high) in ends.items():
        piece = select(table, "SIM", series)
        assert (piece["C"].min(), piece["C"].max()) == pytest.approx((low, high), rel=1e-14)
        squared = 1 - 2 * piece["C"] + (1 + RHO**2) * piece["C"] ** 2
        np.testing.assert_allclose(piece["B"] ** 2, squared, rtol=1e-12)
    for series, C in {"printed": PRINTED, "fold": FOLD, "symmetry breaking": BREAKING}.items():
        assert select(table, "SIM", series)["C"].tolist() == pytest.approx([C], rel=1e-14)


def test_limits_over_kappa(tables):
    table = tables["companion_10_05"]
    rows = {
        series: select(table, "regions", series) for series in ("fold", "symmetry breaking", "penetration", "printed")
    }
    for series, line in rows.items():
        kappa, C = line["kappa"].to_numpy(), line["C"].to_numpy()
        rho = 2 * (1 - kappa) / (np.pi * (1 + kappa))
        expected = {"fold": 1 / (1 + rho**2), "symmetry breaking": BREAKING, "printed": 4 / (4 + np.pi * rho)}
        if series in expected:
            np.testing.assert_allclose(C, expected[series], rtol=1e-13)
            assert len(kappa) == 401
        else:
            # |W| <= 1 just inside, not just outside, by sampling a flight of (10.10).
            t = np.linspace(0, np.pi, 20001)
            for k, r, c in zip(kappa[1::8], rho[1::8], C[1::8], strict=True):
                for factor, within in ((0.999, True), (1.001, False)):
                    x = factor * c
                    W = (1 - x) * np.cos(t) + r * x * np.sin(t) + x * (1 - 2 * t / np.pi)
                    assert (W.max() <= 1 + 1e-9) == within, k
            assert C.max() <= 2.2
    outline = select(table, "regions", "stable")
    assert outline["C"].max() == pytest.approx(BREAKING)
    assert outline["C"].min() == pytest.approx(rows["fold"]["C"].min())


@pytest.mark.parametrize("C_max", [1.6, 5.3])
def test_a_range_that_cuts_the_limits_or_has_no_motion_is_refused(C_max):
    with pytest.raises(ValueError, match=r"^C_max: "):
        companion_10_04.compute(0.65, C_max)


@pytest.mark.parametrize("C_range", [(0.7, 2.0), (0.5, 1.6)])
def test_a_range_that_cuts_the_region_is_refused(C_range):
    with pytest.raises(ValueError, match=r"^C_range: "):
        companion_10_05.compute(C_range)


def test_every_motion_and_verdict_is_in_the_table(tables, verdict_tables):
    points, exact = verdict_tables
    table = tables["companion_stability"]
    shown = table[table["series"].isin(companion_stability.KINDS)]
    motions = pd.concat([points, exact[exact["admissible"]]])
    left = shown.rename(columns={"panel": "case"})[["case", "label", "C1", "C2", *CRITERIA]]
    right = motions[["case", "label", "C1", "C2", *CRITERIA]]
    order = ["case", "label"]
    pd.testing.assert_frame_equal(
        left.sort_values(order).reset_index(drop=True), right.sort_values(order).reset_index(drop=True)
    )


# The pictures


def test_stable_is_bold_solid_and_unstable_dashed(companions):
    (axes,) = companions["companion_10_04"].axes
    curves = [line for line in axes.lines if len(line.get_xdata()) > 2]
    left, stable, right = sorted(curves, key=lambda line: line.get_xdata()[0])
    assert stable.get_linestyle() == "-"
    assert left.get_linestyle() == right.get_linestyle() == "--"
    assert stable.get_linewidth() > left.get_linewidth()
    (band,) = axes.patches
    assert (band.get_x(), band.get_x() + band.get_width()) == pytest.approx((FOLD, BREAKING))


def test_the_stable_region_is_shaded_and_bears_its_name(companions, tables):
    (axes,) = companions["companion_10_05"].axes
    (region,) = axes.patches
    outline = select(tables["companion_10_05"], "regions", "stable")[["kappa", "C"]].to_numpy()
    np.testing.assert_array_equal(region.get_xy()[:-1], outline)
    (word,) = [text for text in axes.texts if text.get_text() == "stable"]
    assert region.get_path().contains_point(word.get_position())


def test_faces_tell_the_verdicts(companions, tables):
    """A marker per motion and criterion, black exactly where the verdict is stable."""
    table = tables["companion_stability"]
    figure = companions["companion_stability"]
    matrices = figure.axes[len(SYSTEMS) :]
    for case, axes in zip(SYSTEMS, matrices, strict=True):
        motions = table[(table["panel"] == case) & table["series"].isin(companion_stability.KINDS)]
        black = {
            (int(line.get_xdata()[0]), int(line.get_ydata()[0])): line.get_markerfacecolor() == "black"
            for line in axes.lines
            if line.get_label() != companion_stability.RING["label"]
        }
        expected = {
            (column, row): motion[criterion] == "stable"
            for row, (_, motion) in enumerate(motions.iterrows())
            for column, criterion in enumerate(CRITERIA)
        }
        assert black == expected


def test_rings_are_where_a_criterion_calls_an_unstable_motion_stable(companions, tables):
    """All symmetric motions are, by their multipliers; of what both time scales say only (c) of equal is refuted."""
    table, figure = tables["companion_stability"], companions["companion_stability"]
    for case, plane, matrix in zip(SYSTEMS, figure.axes, figure.axes[len(SYSTEMS) :], strict=False):
        assert all(np.abs(orbit.multipliers).max() > 1 for orbit in orbits(SYSTEMS[case]) if orbit.symmetric)
        motions = table[(table["panel"] == case) & table["series"].isin(companion_stability.KINDS)]
        refuted = (motions["series"] != "asymmetric").to_numpy()[:, None] & motions[list(CRITERIA)].eq(
            "stable"
        ).to_numpy()
        assert ringed(matrix) == {(column, row) for row, column in np.argwhere(refuted)}
        c = motions[(motions["series"] == "fixed point") & (motions["label"] == "c") & (case == "equal")]
        assert ringed(plane) == set(c[["C1", "C2"]].itertuples(index=False, name=None))


def ringed(axes):
    rings = [line for line in axes.lines if line.get_label() == companion_stability.RING["label"]]
    return {tuple(ring.get_xydata()[0]) for ring in rings}


@pytest.mark.parametrize("name", COMPANIONS)
def test_nothing_is_told_by_colour(companions, name):
    for line in (line for axes in companions[name].axes for line in axes.lines):
        for colour in (line.get_color(), line.get_markerfacecolor()):
            red, green, blue = matplotlib.colors.to_rgb(colour)
            assert red == green == blue


@pytest.mark.parametrize("name", COMPANIONS)
def test_fit_for_print(companions, name):
    """Width of a column or page; lettering of at least 7 points, inside the paper, not on other lettering."""
    figure = companions[name]
    width, height = figure.get_size_inches() * 25.4
    assert round(width, 6) in (84, 174)
    assert height < 235
    renderer = FigureCanvasAgg(figure).get_renderer()
    written = [text for text in figure.findobj(Text) if text.get_visible() and text.get_text()]
    boxes = [(text, Text.get_window_extent(text, renderer)) for text in written if in_frame(text)]
    paper = figure.bbox
    for text, box in boxes:
        assert text.get_fontsize() * (0.7 if set("_^") & set(text.get_text()) else 1) >= 6.999
        assert paper.x0 <= box.x0 < box.x1 <= paper.x1, text.get_text()
        assert paper.y0 <= box.y0 < box.y1 <= paper.y1, text.get_text()
    for (one, first), (other, second) in itertools.combinations(boxes, 2):
        assert not first.padded(-0.5).overlaps(second.padded(-0.5)), (one.get_text(), other.get_text())


def in_frame(text):
    """Not the label of a tick outside the limits or of axes that are switched off."""
    for axes in text.figure.axes:
        for axis, (low, high) in ((axes.xaxis, axes.get_xlim()), (axes.yaxis, axes.get_ylim())):
            for tick in axis.get_major_ticks():
                if text in (tick.label1, tick.label2):
                    return axes.axison and min(low, high) <= tick.get_loc() <= max(low, high)
    return True


@pytest.mark.parametrize("name", COMPANIONS)
def test_a_table_survives_its_file(tables, tmp_path, name):
    write(tables[name], tmp_path / "table.csv")
    pd.testing.assert_frame_equal(read(tmp_path / "table.csv"), tables[name], check_exact=True)
