"""What is drawn: line styles, labels, order of panels, and the same numbers as in the table."""

import matplotlib.colors
import numpy as np
import pytest
from matplotlib.collections import LineCollection
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Circle, FancyArrowPatch, Rectangle
from vibroimpact.figures.kit.artists import describe

from vibroimpact.figures.kit.tables import select


def lines_with(axes, table, panel, series, x, y):
    """Lines that show a series of the table, to the last digit."""
    rows = select(table, panel, series)
    return [line for line in axes.lines if np.array_equal(line.get_xydata(), rows[[x, y]].to_numpy())]


def dashes(line):
    """Lengths of dashes and gaps in points per line width, or None for a solid line."""
    pattern = line.get_linestyle(), line._unscaled_dash_pattern[1]
    return None if pattern[0] == "-" else pattern[1]


def is_dotted(line):
    return dashes(line) is not None and dashes(line)[0] <= 1


def is_dashed(line):
    return dashes(line) is not None and dashes(line)[0] >= 3


def texts(figure):
    return {text.get_text() for text in figure.findobj(lambda artist: hasattr(artist, "get_text")) if text.get_text()}


def branches(axes, table, panel):
    (stable,) = lines_with(axes, table, panel, "SIM stable", "C", "B")
    (unstable,) = lines_with(axes, table, panel, "SIM unstable", "C", "B")
    return stable, unstable


def test_10_1_shows_both_modules_with_all_symbols(drawn):
    figure = drawn["fig10_01"]
    symbols = {"$M$", "$m$"}
    for i in ("1", "2"):
        symbols |= {f"$k_{{{i}}}$", f"$c_{{{i}}}$", f"$F_{i}(t)$", f"$x_{i}$", f"$y_{i}$"}
    assert texts(figure) == symbols | {"$k_{12}$", "$c_{12}$"}
    assert len(figure.findobj(FancyArrowPatch)) == 6
    balls = [circle for circle in figure.findobj(Circle) if circle.radius > 2]
    cavities = [
        box for box in figure.findobj(Rectangle) if box.get_facecolor() == (1, 1, 1, 1) and 10 < box.get_width() < 18
    ]
    assert len(balls) == len(cavities) == 2
    for ball, cavity in zip(balls, cavities, strict=True):
        x, y = ball.center
        assert cavity.get_x() < x - ball.radius < x + ball.radius < cavity.get_x() + cavity.get_width()
        assert cavity.get_y() < y - ball.radius < y + ball.radius < cavity.get_y() + cavity.get_height()


def test_10_2_has_contact_where_the_ball_is_L_off_the_middle(drawn):
    figure = drawn["fig10_02"]
    assert texts(figure) == {"$M$", "$m$", "$L$", "$x_i$", "$y_i$"}
    box, cavity = (patch for patch in figure.findobj(Rectangle) if 40 < patch.get_width() < 70)
    middle = cavity.get_x() + 0.5 * cavity.get_width()
    assert middle == pytest.approx(box.get_x() + 0.5 * box.get_width())
    left, right, ball = figure.findobj(Circle)
    assert (middle - left.center[0]) == pytest.approx(right.center[0] - middle)
    assert left.center[0] - left.radius == pytest.approx(cavity.get_x())
    assert right.center[0] + right.radius == pytest.approx(cavity.get_x() + cavity.get_width())
    assert left.center[0] < ball.center[0] < right.center[0]
    arrows = [sorted((arrow._posA_posB[0][0], arrow._posA_posB[1][0])) for arrow in figure.findobj(FancyArrowPatch)]
    assert sorted(arrows)[:2] == [[pytest.approx(5), pytest.approx(middle)], [pytest.approx(5), ball.center[0]]]
    assert sorted(arrows)[2:] == [[left.center[0], middle], [middle, right.center[0]]]


def test_10_3_marks_amplitude_and_impacts(scenes, drawn):
    (axes,), table = drawn["fig10_03"].axes, scenes["fig10_03"].table
    assert lines_with(axes, table, "Z", "Z", "tau0", "Z")
    (marks,) = lines_with(axes, table, "Z", "impacts", "tau0", "Z")
    assert marks.get_marker() == "o"
    assert [tick.get_text() for tick in axes.get_yticklabels()] == ["$-C_i$", "$0$", "$C_i$"]
    instants = [tick.get_text() for tick in axes.get_xticklabels()]
    assert instants == [r"$\theta_i$", r"$\theta_i+\pi$", r"$\theta_i+2\pi$", r"$\theta_i+3\pi$"]
    assert axes.get_xticks().tolist() == marks.get_xdata().tolist()
    assert (axes.get_xlabel(), axes.get_ylabel()) == (r"$\tau_0$", "$Z_i$")
    assert axes.findobj(LineCollection)


def test_10_4_stable_bold_unstable_dashed_level_dotted(scenes, drawn):
    (axes,), table = drawn["fig10_04"].axes, scenes["fig10_04"].table
    stable, unstable = branches(axes, table, "SIM")
    (level,) = lines_with(axes, table, "SIM", "B_min", "C", "B")
    assert dashes(stable) is None
    assert is_dashed(unstable)
    assert is_dotted(level)
    assert stable.get_linewidth() >= 1.5 * unstable.get_linewidth()
    assert [text.get_text() for text in axes.get_legend().get_texts()] == ["stable", "unstable"]
    assert {r"$B_{\min}$", "$C_i$", "$B_i$"} <= texts(drawn["fig10_04"])


def test_10_5_stable_shaded_unstable_white_fold_dotted(scenes, drawn):
    (axes,), table = drawn["fig10_05"].axes, scenes["fig10_05"].table
    shades = {}
    for patch in axes.patches:
        for name in ("stable", "unstable"):
            if np.array_equal(patch.get_xy()[:-1], select(table, "regions", name)[["kappa", "C"]].to_numpy()):
                shades[name] = patch
    assert matplotlib.colors.to_rgb(shades["unstable"].get_facecolor()) == (1, 1, 1)
    assert 0.6 < matplotlib.colors.to_rgb(shades["stable"].get_facecolor())[0] < 0.9
    (fold,) = lines_with(axes, table, "regions", "C_min", "kappa", "C")
    assert is_dotted(fold)
    words = {
        text.get_text(): axes.transData.inverted().transform(text.get_window_extent().get_points())
        for text in axes.texts
    }
    for name, patch in shades.items():  # each region bears its name, so that the sides cannot be confused
        assert patch.get_path().contains_points(words[name]).all()
    assert (axes.get_xlabel(), axes.get_ylabel()) == (r"$\kappa$", "$C_i$")


@pytest.mark.parametrize(("name", "rows"), [("fig10_06", "abc"), ("fig10_09", "abc"), ("fig10_10", "a")])
def test_planes_show_branches_circles_and_squares(scenes, drawn, name, rows):
    table, axes = scenes[name].table, drawn[name].axes
    for row, label in enumerate(rows):
        for module in (1, 2):
            plane, panel = axes[2 * row + module - 1], f"{label}{module}"
            assert plane.get_ylabel() == f"$B_{module}$"
            stable, unstable = branches(plane, table, panel)
            assert dashes(stable) is None
            assert is_dashed(unstable)
            assert stable.get_linewidth() >= 1.5 * unstable.get_linewidth()
            (circles,) = lines_with(plane, table, panel, f"P_{module}", "C", "B")
            (squares,) = lines_with(plane, table, panel, f"S_{module}", "C", "B")
            assert (circles.get_marker(), circles.get_color()) == ("o", "black")
            assert squares.get_marker() == "s"
            assert 0.3 < float(squares.get_color()) < 0.7
            names = [text.get_text() for text in plane.texts]
            assert names.count(f"$P_{module}$") == 1
            assert names.count(f"$S_{module}$") == len(squares.get_xdata())
            beyond = len(select(table, panel, f"S_{module} beyond")) > 0
            assert (rf"$S_{module}\!\nearrow$" in names) == beyond
        if len(rows) > 1:
            assert axes[2 * row].get_title("left") == label


@pytest.mark.parametrize("name", ["fig10_07", "fig10_10"])
def test_boxes_grey_balls_black_and_all_four_told_apart(scenes, drawn, name):
    table = scenes[name].table
    for module, axes in zip((1, 2), drawn[name].axes[-2:], strict=True):
        lines = {}
        for key in "UXWY":
            (lines[key],) = lines_with(axes, table, f"module {module}", f"{key}_{module}", "tau", "value")
        assert {lines["W"].get_color(), lines["Y"].get_color()} == {"black"}
        assert all(0.4 <= float(lines[key].get_color()) <= 0.65 for key in "UX")
        assert (dashes(lines["U"]), dashes(lines["W"])) == (None, None)
        assert is_dashed(lines["X"])
        assert is_dashed(lines["Y"])
        legend = [text.get_text() for text in axes.get_legend().get_texts()]
        assert legend == [f"${key}_{module}$" for key in "UXWY"]
    assert drawn[name].axes[-1].get_xlabel() == r"$\tau$"


@pytest.mark.parametrize("name", ["fig10_08", "fig10_11"])
def test_simulations_show_the_box_above_the_ball(scenes, drawn, name):
    above, below = drawn[name].axes
    assert above.get_position().y0 > below.get_position().y1
    assert (above.get_title("left"), below.get_title("left")) == ("a", "b")
    assert (above.get_ylabel(), below.get_ylabel()) == ("$X_2$", "$W_2$")
    assert lines_with(above, scenes[name].table, "a", "X_2", "tau", "value")
    assert lines_with(below, scenes[name].table, "b", "W_2", "tau", "value")
    assert {tuple(line.get_ydata()) for line in below.lines[1:]} == {(-1, -1), (1, 1)}


def test_nothing_is_told_by_colour(drawn, name):
    """All artists are black, white or grey: colour-blind readers and grey prints lose nothing."""
    for artist in drawn[name].findobj():
        for getter in ("get_color", "get_facecolor", "get_edgecolor"):
            if isinstance(artist, Line2D) or hasattr(artist, getter):
                colour = getattr(artist, getter, lambda: "black")()
                for red, green, blue, _ in matplotlib.colors.to_rgba_array(colour):
                    assert red == green == blue


def scale_of_a_map(lowest, highest):
    figure = Figure()
    figure.subplots().pcolormesh([[lowest, highest]], cmap="Greys")
    return describe(figure)["axes"][0]["collections"][0]["faces"]


def test_the_scale_of_a_map_does_not_hang_on_last_digits():
    for highest in np.random.default_rng(2).uniform(0.3, 0.9, 40):
        scale = scale_of_a_map(0.1, highest)
        assert len(set(scale)) == len(scale)
        assert scale_of_a_map(0.1, np.nextafter(highest, 1)) == scale
        assert scale_of_a_map(np.nextafter(0.1, 0), highest) == scale
