"""All published figures, drawn from their tables, are suitable for print and grey print, and reproducible."""

import json
import sys
from importlib import import_module

import matplotlib
import matplotlib.colors
import numpy as np
import pytest
from matplotlib.lines import Line2D
from matplotlib.text import Text
from PIL import Image

from pipeline_trees import ROOT
from vibroimpact import tables
from vibroimpact.figures import fig10_04
from vibroimpact.figures.plotting import style
from vibroimpact_pipeline.figure_check.check import compared_files
from vibroimpact_pipeline.specs import spec_of, specs

PUBLISHED = {path.stem: path.parent for path in sorted((ROOT / "figures").rglob("*.png"))}
"""Folder of the reference set of each figure."""
FIGURES = {figure: spec_of(figure, {}, specs()) for figure in PUBLISHED}


def lightness(colour):
    """Return the lightness CIE L* of an RGB colour, 0 to 100, which is all that grey print shows."""
    channels = np.array(colour)
    linear = np.where(channels <= 0.04045, channels / 12.92, ((channels + 0.055) / 1.055) ** 2.4)
    return 116 * np.cbrt(linear @ [0.2126, 0.7152, 0.0722]) - 16


@pytest.mark.parametrize("name", FIGURES)
def test_figures_are_suitable_for_print(name):
    """Figures have the width of a column or page, nothing beyond the paper, legible text, and no line by hue alone."""
    spec = FIGURES[name]
    read = {key: tables.read(PUBLISHED[name] / file) for key, (file, _) in compared_files(name, spec).items()}
    figure = style.draw_tables(import_module(spec["module"]), read)
    figure.draw_without_rendering()
    width, height = figure.get_size_inches() * 25.4
    assert round(width, 6) in (84, 174)
    assert height < 235
    needed = figure.get_tightbbox()
    assert min(needed.x0, needed.y0) > -0.02
    assert needed.x1 < width / 25.4 + 0.02
    assert needed.y1 < height / 25.4 + 0.02
    for text in figure.findobj(Text):
        assert text.get_fontsize() * (0.7 if "_" in text.get_text() else 1) >= 6.999, text.get_text()
    keys = [*figure.legends, *(axes.get_legend() for axes in figure.axes if axes.get_legend())]
    assert all(len(key.get_texts()) <= 7 for key in keys)
    looks = {(str(line.get_marker()), matplotlib.colors.to_rgb(line.get_color())) for line in figure.findobj(Line2D)}
    hues = {hue for _, hue in looks if len(set(hue)) > 1}
    for marker in {marker for marker, _ in looks}:
        same_marker = {hue for other, hue in looks if other == marker and hue in hues}
        contrast = np.diff(sorted(lightness(hue) for hue in same_marker | {(0.0, 0.0, 0.0)}))
        assert all(contrast > 15), f"colours that look alike in grey print: {same_marker}"
    unlabelled = hues - {matplotlib.colors.to_rgb(text.get_color()) for text in figure.findobj(Text)}
    assert not unlabelled, f"lines of colour {unlabelled} need a label in their colour"


def test_files_have_the_same_bytes_under_other_settings_and_contain_versions_but_no_date(tmp_path):
    """Matplotlib writes its own version into a picture."""
    table = tables.read(ROOT / "figures/fig10_04.csv")
    written = []
    for size, colour in ((10, "white"), (20, "red")):
        outputs = {kind: tmp_path / f"{size}.{kind}" for kind in ("png", "pdf", "svg", "provenance")}
        with matplotlib.rc_context({"font.size": size, "axes.facecolor": colour, "svg.hashsalt": None}):
            before = dict(matplotlib.rcParams)
            style.save(fig10_04.draw(table), outputs)
            assert dict(matplotlib.rcParams) == before
        written.append({kind: path.read_bytes() for kind, path in outputs.items()})
    assert written[0] == written[1]
    assert not any(mark in written[0]["pdf"] for mark in (b"CreationDate", b"ModDate"))
    assert b"dc:date" not in written[0]["svg"]
    versions = json.loads(written[0]["provenance"])["versions"]
    assert Image.open(outputs["png"]).text["Software"].startswith(f"Matplotlib version{versions['matplotlib']},")
    assert versions["python"] == sys.version.split()[0]


def test_a_picture_is_drawn_from_the_written_table_which_has_all_digits(tmp_path, monkeypatch):
    values = np.array([0.1, 1 / 3, 5e-324, 1.7976931348623157e308, -0.0, np.pi])
    drawn, written = [], tables.join([tables.curve("p", "s", x=values, y=values[::-1])])
    monkeypatch.setattr(fig10_04, "draw", lambda table: drawn.append(table) or style.new_figure(84, 50))
    style.write_and_draw(fig10_04, written, {"csv": tmp_path / "t.csv", "png": tmp_path / "t.png"})
    assert drawn[0] is not written
    assert (drawn[0]["x"].to_numpy().view("i8") == values.view("i8")).all()
