"""Figures and tables as files: deterministic, atomic, independent of the user's settings, read back without loss."""

import matplotlib
import numpy as np
import pandas as pd
import pytest
from matplotlib.figure import Figure
from PIL import Image, ImageChops
from vibroimpact.figures.kit.files import replacing

from vibroimpact.figures.kit import style, tables

KINDS = ("png", "pdf", "svg")


def files(folder, figure, kinds=KINDS):
    outputs = {kind: folder / f"figure.{kind}" for kind in kinds}
    style.save(figure, outputs)
    return {kind: path.read_bytes() for kind, path in outputs.items()}


@pytest.mark.parametrize(("name", "kinds"), [("fig10_01", KINDS), ("fig10_06", ["svg"]), ("fig10_10", ["svg"])])
def test_same_bytes_again_whatever_the_user_has_set(scenes, tmp_path, name, kinds):
    scene = scenes[name]
    first = files(tmp_path / "first", scene.draw(scene.table), kinds)
    with matplotlib.rc_context({"font.size": 20, "savefig.dpi": 50, "svg.hashsalt": None, "lines.linewidth": 7}):
        second = files(tmp_path / "second", scene.draw(scene.table), kinds)
    assert first == second


def test_no_date_in_any_file(scenes, tmp_path):
    content = files(tmp_path, scenes["fig10_04"].draw(scenes["fig10_04"].table))
    assert not any(mark in content["pdf"] for mark in (b"CreationDate", b"ModDate"))
    assert b"dc:date" not in content["svg"]
    assert "Creation Time" not in Image.open(tmp_path / "figure.png").info


def test_png_has_the_printed_width_at_600_dpi(scenes, tmp_path):
    files(tmp_path, scenes["fig10_02"].draw(None))
    picture = Image.open(tmp_path / "figure.png")
    assert picture.size[0] == int(84 / 25.4 * 600)
    assert picture.info["dpi"] == pytest.approx((600, 600), rel=1e-3)


@pytest.mark.parametrize(
    ("colour", "background", "mode"), [("0.3", "white", "L"), ("tab:red", "white", "RGB"), ("0.3", "none", "RGBA")]
)
def test_png_has_the_pixels_of_matplotlib_in_no_more_channels_than_needed(tmp_path, colour, background, mode):
    figure = Figure(facecolor=background)
    figure.add_subplot(facecolor=background).plot([1, 3, 2], color=colour)
    for name, backend in (("own", "module://vibroimpact.figures.kit.plain_png"), ("its", "agg")):
        figure.savefig(tmp_path / name, format="png", facecolor=background, backend=backend)
    own, its = (Image.open(tmp_path / name) for name in ("own", "its"))
    assert own.mode == mode
    assert ImageChops.difference(own.convert("RGBA"), its).getbbox(alpha_only=False) is None


def test_table_read_back_is_equal_and_gives_the_same_picture(scenes, tmp_path, name_with_table):
    scene = scenes[name_with_table]
    tables.write(scene.table, tmp_path / "figure.csv")
    again = tables.read(tmp_path / "figure.csv")
    pd.testing.assert_frame_equal(again, scene.table, check_exact=True)
    assert files(tmp_path, scene.draw(again), ["svg"]) == files(tmp_path, scene.draw(scene.table), ["svg"])


def test_tables_are_tidy(scenes, name_with_table):
    table = scenes[name_with_table].table
    assert list(table.columns[:2]) == ["panel", "series"]
    quantities = table.drop(columns=["panel", "series"])
    assert all(np.issubdtype(kind, np.floating) for kind in quantities.dtypes)
    assert (table["panel"].str.len() > 0).all()
    # Every row is a point: two quantities and no more.
    assert (quantities.notna().sum(axis=1) == 2).all()


def test_a_table_keeps_every_digit(tmp_path):
    values = np.array([0.1, 1 / 3, 5e-324, 1.7976931348623157e308, -0.0, np.pi])
    tables.write(tables.join([tables.curve("p", "s", x=values, y=values[::-1])]), tmp_path / "t.csv")
    assert (tables.read(tmp_path / "t.csv")["x"].to_numpy().view("i8") == values.view("i8")).all()


def fail_half_way(path):
    path.write_text("new")
    raise OSError("no such luck")


def test_a_failed_write_leaves_the_old_file(tmp_path):
    target = tmp_path / "folder" / "file.txt"
    with replacing(target) as path:
        path.write_text("old")
    with pytest.raises(OSError, match="no such"), replacing(target) as path:
        fail_half_way(path)
    assert target.read_text() == "old"
    assert [file.name for file in target.parent.iterdir()] == ["file.txt"]


def test_drawing_leaves_the_settings_of_the_caller_alone(scenes):
    with matplotlib.rc_context({"font.size": 20}):
        before = dict(matplotlib.rcParams)
        scenes["fig10_04"].draw(scenes["fig10_04"].table)
        assert dict(matplotlib.rcParams) == before
