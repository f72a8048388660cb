"""The accuracy charts show all rows of the methods that they draw, and their labels cover nothing."""

import numpy as np
import pandas as pd
import pytest
from matplotlib.transforms import Bbox

from pipeline_trees import ROOT
from vibroimpact.figures import fig10_06, fig10_09, stress_tests, work_precision
from vibroimpact.figures.plotting.methods import HOLLOW, LOOKS
from vibroimpact.tables import read

ROW = dict(
    problem="s", method="heyoka", family="Taylor", setting="1", error_state=1e-6, error_time=1e-7, missed=0, spurious=0
)
ROW |= dict(seconds_per_cycle=1e-3, outcome="finished", reason="", order=None)


def texts(figure):
    return [text.get_text() for text in figure.findobj(lambda artist: hasattr(artist, "get_text"))]


def points(axes, hollow=False):
    """Return the places of the filled or of the hollow markers."""
    marked = [line for line in axes.lines if line.get_marker() not in ("", "None")]
    chosen = [line for line in marked if (line.get_markerfacecolor() == "white") == hollow]
    return {tuple(place) for line in chosen for place in line.get_xydata()}


def test_the_chart_shows_failed_runs_in_their_lane_and_names_methods_that_are_not_installed():
    rows = [
        ROW,
        ROW | dict(setting="2", error_state=1e-8, missed=1),
        ROW | dict(method="DOP853", error_state=np.inf, error_time=np.inf, outcome="refused", reason="gave up"),
        ROW | dict(method="RK4, compiled", seconds_per_cycle=None, outcome="unavailable", reason="not installed"),
        ROW | dict(method="Hertz", error_state=1e-3),
    ]
    figure = work_precision.draw(pd.DataFrame(rows))
    hollow = points(figure.axes[0], hollow=True)
    assert hollow == {(1e-8, 1e-3)}
    assert points(figure.axes[0]) - hollow == {(1e-6, 1e-3), (work_precision.NO_RESULT, 1e-3)}
    shown = texts(figure)
    assert HOLLOW in shown
    assert "no result (not installed: RK4, compiled)" in shown
    assert {"heyoka", "DOP853"} <= {*shown}
    assert "Hertz" not in shown


def test_labels_cover_no_curve_marker_or_label_with_the_timings_of_another_machine():
    """The timings of the reference set are multiplied by random factors of up to some 3."""
    table = read(ROOT / "figures/work_precision.csv")
    random = np.random.default_rng(0)
    factors = dict(zip(table["method"].unique(), np.exp(random.normal(0.0, 0.5, 99)), strict=False))
    table["seconds_per_cycle"] *= table["method"].map(factors) * np.exp(random.normal(0.0, 0.15, len(table)))
    figure = work_precision.draw(table)
    for axes, (_, rows) in zip(figure.axes, table.groupby("problem", sort=False), strict=True):
        assert_labels_cover_nothing(axes)
        measured = rows[rows["method"].isin([*LOOKS]) & rows["seconds_per_cycle"].notna()]
        # A method with results and failed runs has two names.
        pieces = measured.assign(failed=measured["outcome"] != "finished").drop_duplicates(["method", "failed"])
        assert sorted(text.get_text() for text in axes.texts) == sorted(pieces["method"])


@pytest.mark.parametrize("figure", [fig10_06, fig10_09])
def test_labels_of_points_cover_nothing_and_an_inset_shows_points_near_the_fold(figure):
    table = read(ROOT / f"figures/{figure.__name__.rpartition('.')[2]}.csv")
    drawn = figure.draw(table)
    points = table[table["series"].str.fullmatch("[SP]_[12]")]
    near = points[points["C"].between(*fig10_06.ZOOM["xlim"])].groupby("panel").size()
    for axes, panel in zip(drawn.axes, table["panel"].unique(), strict=True):
        assert len(axes.child_axes) == (near.get(panel, 0) > 1)
        for pane in (axes, *axes.child_axes):
            assert_labels_cover_nothing(pane)
        names = [text.get_text() for pane in (axes, *axes.child_axes) for text in pane.texts]
        inside, S = points.loc[points["panel"] == panel, "series"], f"S_{panel[-1]}"
        beyond = table.loc[(table["panel"] == panel) & (table["series"] == f"{S} beyond"), "C"]
        corner = [rf"${S}\,\rightarrow$" f"\nat $C_{panel[-1]} = {C:.1f}$" for C in beyond] or [f"no ${S}$"] * (
            S not in set(inside)
        )
        assert sorted(names) == sorted([*(f"${name}$" for name in inside), *corner])


def assert_labels_cover_nothing(axes):
    """Check that no text overlaps another text, a line or a marker; a leader may end at the edge of its text."""
    boxes = [text.get_window_extent() for text in axes.texts]
    for n, box in enumerate(boxes):
        assert not any(box.overlaps(other) for other in boxes[:n])
        assert axes.get_window_extent().contains(box.x0, box.y0)
        assert axes.get_window_extent().contains(box.x1, box.y1)
        inner = box.padded(-1)  # excludes the end of a leader
        for line in axes.lines:
            path = line.get_transform().transform_path(line.get_path())
            if line.get_linestyle() != "None" and len(path.vertices) > 1:
                assert not path.intersects_bbox(inner, filled=False)
            if line.get_marker() not in ("", "None"):
                half = line.get_markersize() / 2 * axes.figure.dpi / 72
                assert not any(box.overlaps(Bbox([place - half, place + half])) for place in path.vertices)


def test_a_group_of_stress_tests_shows_its_worst_verdict_and_the_number_of_right_ones():
    verdicts = list(stress_tests.VERDICTS)
    rows = [dict(group=worst, method="m", verdict=verdict) for worst in verdicts for verdict in ("right", worst)]
    shown = texts(stress_tests.draw(pd.DataFrame(rows)))
    for verdict, (mark, _) in stress_tests.VERDICTS.items():
        assert f"{mark}  {verdict}" in shown
        assert shown.count(mark) == (0 if verdict == "unavailable" else 2 if verdict == "right" else 1)
    assert [shown.count("2/2"), shown.count("1/2")] == [1, len(verdicts) - 1]


def test_the_error_of_a_missed_impact_is_proportional_to_the_square_root_of_its_depth():
    """The speed of the missed impact is the square root of twice the depth times the acceleration."""
    table = read(ROOT / "figures/grazing.csv")
    missed = table[(table["method"] == "DOP853") & (table["missed"] > 0)]
    assert len(missed) > 8
    slope = np.polyfit(-np.log(10) * missed["digits"], np.log(missed["error_state"]), 1)[0]
    assert slope == pytest.approx(0.5, abs=0.01)
    engine = table[table["method"] == "this engine"]
    assert (engine["missed"] + engine["spurious"] == 0).all()
    assert (engine["error_state"] < 1e-7).all()
