"""The figure check, tested by mutation: what is wrong is caught, and rounding is not."""

import json
import re
import shutil

import numpy as np
import pytest
from matplotlib.transforms import Bbox

from checking import LIMITS, assert_caught, check_all, page_of
from vibroimpact.figures.kit import manifold, style
from vibroimpact_pipeline.figure_check import compare as figure_check
from vibroimpact_pipeline.figure_check.verdicts import by_distance, has_failed, largest, lines

WITH_POINTS = ["fig10_06", "fig10_07", "fig10_10"]


def other_rounding(table, units=4, seed=1):
    """A table as another machine might round it: every number off by some units in the last place."""
    random = np.random.default_rng(seed)
    numbers = table.select_dtypes("float")
    return table.assign(**numbers + np.spacing(numbers) * random.integers(-units, units + 1, numbers.shape))


@pytest.mark.parametrize("name", ["fig10_01", "fig10_03", "fig10_04", "fig10_05", *WITH_POINTS, "fig10_08"])
def test_the_rounding_of_another_machine_passes(figures, verdict, name):
    """Inputs and outputs of a figure are spoilt in their last digits, and the picture is drawn from that."""
    scene = figures[name]
    table = scene.compute and other_rounding(scene.compute(rounding=other_rounding), seed=2)
    found = verdict(name, table, scene.draw(table))
    assert (found["status"], found["reasons"]) == ("passed", [])
    assert largest(found) < 0.5
    assert table is None or largest(found) > 0


@pytest.mark.parametrize("name", ["fig10_04", *WITH_POINTS, "fig10_08"])
def test_kappa_off_by_one_per_cent_is_caught(figures, verdict_without_pixels, name):
    table = figures[name].compute(kappa=0.65 * 1.01)
    assert_caught(verdict_without_pixels(name, table, figures[name].draw(table)), f"{name}.csv")


@pytest.mark.parametrize("name", [*WITH_POINTS, "fig10_08"])
def test_f20_off_by_half_a_per_cent_is_caught(figures, verdict_without_pixels, name):
    f20_hat = 0.5 if name == "fig10_10" else 1.0
    table = figures[name].compute(f20_hat=f20_hat * 1.005)
    assert_caught(verdict_without_pixels(name, table, figures[name].draw(table)), f"{name}.csv")


def test_a_dropped_fixed_point_is_caught(figures, verdict_without_pixels):
    table = figures["fig10_06"].compute(edit=lambda points: points[points["label"] != "b"])
    assert_caught(
        verdict_without_pixels("fig10_06", table, figures["fig10_06"].draw(table)), "b1, P_1: no rows instead of 1"
    )


@pytest.mark.parametrize("name", ["fig10_04", "fig10_06", "fig10_10"])
def test_a_branch_in_the_wrong_style_is_caught(figures, computed, verdict_without_pixels, monkeypatch, name):
    monkeypatch.setitem(manifold.BRANCHES, "SIM unstable", style.STABLE)
    found = verdict_without_pixels(name, computed[name], figures[name].draw(computed[name]))
    assert_caught(found, "(unstable), dashes: solid instead of [4.5, 2.5]")
    assert all(column["distance"] == 0 for column in found["tables"])


@pytest.mark.parametrize("name", ["fig10_04", "fig10_07", "fig10_10"])
def test_a_lost_legend_is_caught(figures, computed, verdict_without_pixels, name):
    drawn = figures[name].draw(computed[name])
    drawn.axes[-1].get_legend().remove()
    assert_caught(verdict_without_pixels(name, computed[name], drawn), "legend: nothing instead of ")


@pytest.mark.parametrize("name", ["fig10_06", "fig10_07", "fig10_08", "fig10_10"])
def test_swapped_panels_are_caught(figures, computed, verdict_without_pixels, name):
    """The first two panels change places on paper; no number and no style changes."""
    drawn = figures[name].draw(computed[name])
    first, second = drawn.axes[:2]
    places = first.get_subplotspec(), second.get_subplotspec()
    first.set_subplotspec(places[1])
    second.set_subplotspec(places[0])
    assert_caught(verdict_without_pixels(name, computed[name], drawn), "figure, axes 1, ")


def test_swapped_contents_of_like_panels_are_caught(figures, computed, verdict_without_pixels):
    """Rows a and b of figure 10.6 look alike: only the places of their points tell them apart."""
    table = computed["fig10_06"]
    swapped = table.assign(panel=table["panel"].replace({"a1": "b1", "b1": "a1", "a2": "b2", "b2": "a2"}))
    in_order = swapped.sort_values("panel", kind="stable", ignore_index=True)
    assert_caught(verdict_without_pixels("fig10_06", table, figures["fig10_06"].draw(in_order)), "($P_1$), at 1: ")


@pytest.mark.parametrize(("name", "column"), [("fig10_07", "tau"), ("fig10_08", "tau"), ("fig10_05", "C")])
def test_a_wrong_unit_is_caught(figures, computed, verdict_without_pixels, name, column):
    table = computed[name].assign(**{column: computed[name][column] / (2 * np.pi)})
    assert_caught(verdict_without_pixels(name, table, figures[name].draw(table)), f"{name}.csv: {column} is off by ")


def test_a_wrong_unit_on_an_axis_is_caught(figures, computed, verdict_without_pixels):
    drawn = figures["fig10_08"].draw(computed["fig10_08"])
    drawn.axes[-1].set_xlabel("$t$ [s]")
    found = verdict_without_pixels("fig10_08", computed["fig10_08"], drawn)
    assert_caught(found, "label 1 ($\\tau$), text: $t$ [s] instead of $\\tau$")


@pytest.mark.parametrize("name", ["fig10_03", "fig10_04", "fig10_05", "fig10_06", "fig10_07", "fig10_08", "fig10_10"])
@pytest.mark.parametrize("along", ["x", "y"])
def test_a_changed_axis_limit_is_caught(figures, computed, verdict_without_pixels, name, along):
    drawn = figures[name].draw(computed[name])
    axes = drawn.axes[-1]
    low, high = getattr(axes, f"get_{along}lim")()
    axes.set(**{f"{along}lim": (low, high + 0.01 * (high - low))})
    assert_caught(verdict_without_pixels(name, computed[name], drawn), f"{along}lim: ")


def test_a_change_that_only_pixels_show_is_caught(figures, verdict):
    """A line that is clipped away is still there as an artist."""
    drawn = figures["fig10_01"].draw(None)
    longest = max(drawn.axes[0].lines, key=lambda line: np.ptp(line.get_xdata()))
    longest.set_clip_box(Bbox.from_extents(-2, -2, -1, -1))
    assert_caught(verdict("fig10_01", None, drawn), "picture: a square of 4 pixels changes by 1, limit")


def test_other_versions_are_no_pass_and_no_alarm_but_a_lost_dash_is_found(figures, computed, verdict, monkeypatch):
    monkeypatch.setattr(style, "drawn_with", lambda: {"matplotlib": "9.9", "freetype": "9.9"})
    table, draw = computed["fig10_04"], figures["fig10_04"].draw
    found = verdict("fig10_04", table, draw(table))
    assert (found["status"], found["reasons"]) == ("not comparable", [])
    assert found["picture"]["drawn with"] == {"matplotlib": "9.9", "freetype": "9.9"}
    assert not has_failed([found])
    assert has_failed([found], strict=True)
    monkeypatch.setitem(manifold.BRANCHES, "SIM unstable", style.STABLE)
    assert_caught(verdict("fig10_04", table, draw(table)), "dashes")


@pytest.mark.parametrize("lost", ["fig10_04.csv", "fig10_04.png", "fig10_04.artists.json"])
def test_a_missing_file_is_a_failure(reference, tmp_path, lost):
    shutil.copytree(reference, tmp_path / "less")
    (tmp_path / "less" / lost).unlink()
    found = figure_check.check("fig10_04", tmp_path / "less", reference, LIMITS)
    assert (found["status"], found["reasons"]) == ("failed", [f"no reference: {lost}"])
    found = figure_check.check("fig10_04", reference, tmp_path / "less", LIMITS)
    assert (found["status"], found["reasons"]) == ("failed", [f"not built: {lost}"])


def test_a_figure_that_is_no_longer_built_is_a_failure(reference, tmp_path):
    found = check_all([], reference, tmp_path, LIMITS)
    assert len(found) == len(figure_check.figures_in(reference)) > 5
    assert all(verdict["reasons"][0].startswith("not built: ") for verdict in found)


def test_nothing_to_check_is_a_failure(tmp_path):
    assert has_failed(check_all([], tmp_path, tmp_path, LIMITS))


@pytest.mark.parametrize(
    ("name", "content"),
    [("fig10_04.csv", ""), ("fig10_04.png", "no picture"), ("fig10_04.artists.json", "{"), ("fig10_04.csv", "a\n1\n")],
)
def test_a_spoilt_file_is_a_failure_of_its_figure(reference, tmp_path, name, content):
    shutil.copytree(reference, tmp_path / "spoilt")
    (tmp_path / "spoilt" / name).write_text(content)
    found = figure_check.check("fig10_04", reference, tmp_path / "spoilt", LIMITS)
    assert found["status"] == "failed"
    assert len(found["reasons"]) == 1


@pytest.mark.parametrize("value", [np.nan, np.inf])
def test_a_number_that_is_not_finite_is_caught(figures, computed, verdict_without_pixels, value):
    table = computed["fig10_04"].copy()
    table.loc[7, "B"] = value
    assert_caught(
        verdict_without_pixels("fig10_04", table, figures["fig10_04"].draw(computed["fig10_04"])), "fig10_04.csv: "
    )


def test_a_column_without_a_limit_is_a_failure(reference):
    limits = LIMITS | {"columns": LIMITS["columns"] | {"fig10_04": {"C": "algebra"}}}
    found = figure_check.check("fig10_04", reference, reference, limits)
    assert found["reasons"] == ["fig10_04.csv: no limit is stated for column B"]


def test_statistics_beside_a_figure_are_compared_value_by_value(reference, tmp_path):
    old, new = tmp_path / "old", tmp_path / "new"
    shutil.copytree(reference, old)
    (old / "fig10_04_statistics.csv").write_text("quantity,value\ndepth,0.5\nlength,4000\n")
    limits = LIMITS | {"columns": LIMITS["columns"] | {"fig10_04_statistics": {"value": "exact"}}}
    shutil.copytree(old, new)
    assert figure_check.check("fig10_04", old, new, limits)["status"] == "passed"
    (new / "fig10_04_statistics.csv").write_text("quantity,value\ndepth,0.50001\nlength,4000\n")
    assert_caught(figure_check.check("fig10_04", old, new, limits), "value is off by 2e-05 of its axis")


def test_every_limit_has_its_reason_and_every_column_its_limit(computed):
    kinds = [*LIMITS["tables"].values(), *LIMITS["infinite"].values(), *LIMITS["picture"]["measures"].values()]
    assert all(entry["reason"] for entry in [*kinds, LIMITS["artists"], LIMITS["same rounding"]])
    for name, table in computed.items():
        if table is not None:
            assert set(LIMITS["columns"][name]) == set(table.select_dtypes("number"))


def test_lines_say_why_and_the_data_are_plain_json(reference, tmp_path):
    shutil.copytree(reference, tmp_path / "new")
    (tmp_path / "new/fig10_05.csv").unlink()
    verdicts = check_all(["fig10_05"], reference, tmp_path / "new", LIMITS)
    assert has_failed(verdicts)
    first, last = lines(verdicts)
    assert first == "fig10_05: failed: not built: fig10_05.csv"
    assert last == "8 figures: 7 passed, 1 failed; largest distance 0 of its limit"
    assert json.loads(json.dumps(verdicts, allow_nan=False)) == verdicts


@pytest.mark.parametrize(("distance", "commands"), [(0.0, 0), (0.5, 1)])
def test_a_figure_that_has_drifted_can_be_accepted_from_its_place(reference, distance, commands):
    verdict = figure_check.check("fig10_04", reference, reference, LIMITS)
    drifted = verdict | {"artists": {"distance": distance, "limit": 1.0}}
    assert drifted["status"] == "passed"
    html = page_of([drifted], reference, reference)
    assert html.count("make accept REASON=&#34;why&#34; FIGURES=&#34;fig10_04&#34;") == commands


def test_the_page_shows_all_and_fetches_nothing(reference, tmp_path):
    shutil.copytree(reference, tmp_path / "new")
    shutil.copy(reference / "fig10_04.png", tmp_path / "new/fig10_05.png")
    (tmp_path / "new/fig10_03.png").write_bytes(b"")
    verdicts = check_all([], reference, tmp_path / "new", LIMITS)
    html = page_of(verdicts, reference, tmp_path / "new")
    assert html.count("<img ") == 2 * len(verdicts)  # one has no new picture, one has a difference, too
    assert html.count("No pixel differs") == len(verdicts) - 2
    assert html.count("alt=") == html.count("<img ")
    assert 'src="http' not in html
    assert "url(" not in html
    assert all(f'id="{verdict["figure"]}"' in html for verdict in verdicts)
    shown = re.findall(r'<section id="(fig10_\d+)"', html)
    assert shown == [verdict["figure"] for verdict in by_distance(verdicts)]
    assert set(shown[:2]) == {"fig10_03", "fig10_05"}
    assert html.count("make accept REASON=&#34;why&#34; FIGURES=&#34;fig10_05&#34;") == 1
    assert "make accept REASON=&#34;why&#34; FIGURES=&#34;fig10_03 fig10_05&#34;" in html
