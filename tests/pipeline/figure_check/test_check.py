"""Test which changes of numbers, drawing code and files the figure check accepts."""

import json
import re
import zlib
from functools import partial

import numpy as np
import pytest
from matplotlib.figure import Figure
from PIL import Image

from vibroimpact import tables
from vibroimpact.figures import fig10_02, fig10_04, fig10_06
from vibroimpact.figures.plotting import drawing, style
from vibroimpact_pipeline.figure_check import check as checks
from vibroimpact_pipeline.figure_check import pictures
from vibroimpact_pipeline.figure_check.check import SUMS, check_all, has_failed, lines
from vibroimpact_pipeline.figure_check.page import difference, page

FIGURES = ["fig10_02", "fig10_04", "fig10_06", "fig10_11"]
DIFFERS = "picture: {} drawn from the reference tables differs from the reference"


@pytest.mark.parametrize("figure", FIGURES)
def test_a_figure_that_equals_its_reference_passes_whatever_its_metadata_contain(tree, figure):
    svg = tree.results / f"{figure}.svg"
    svg.write_text(svg.read_text().replace("</metadata>", "<!-- another build --></metadata>"))
    verdict = tree.verdict(figure)
    assert (verdict["status"], verdict["reasons"], verdict["distance"]) == ("passed", [], 0.0)


# Drawing code


def draw_branches_and_dot(axes, table, panel, draw_branches=fig10_04.draw_branches):
    draw_branches(axes, table, panel)
    axes.plot([1.0], [0.5], ".", color="0.5", markersize=1)


CHANGES = {
    "a little thicker": ("fig10_04", lambda patch: patch.setitem(style.STABLE, "linewidth", 1.83)),
    "other dashes": ("fig10_04", lambda patch: patch.setitem(style.UNSTABLE, "linestyle", (0, (4.5, 2.6)))),
    "another grey": ("fig10_04", lambda patch: patch.setitem(style.LEVEL, "color", "0.01")),
    "a dot added": ("fig10_04", lambda patch: patch.setattr(fig10_04, "draw_branches", draw_branches_and_dot)),
    "a smaller marker": ("fig10_06", lambda patch: patch.setitem(fig10_06.MARKERS["P"], "markersize", 4.1)),
    "a taller row": ("fig10_06", lambda patch: patch.setattr(fig10_06, "ROW_HEIGHT", 35.5)),
    "a vertex off": ("fig10_02", lambda patch: patch.setattr(fig10_02, "CAVITY_BOTTOM", 13.6)),
    "a label turned": ("fig10_02", lambda patch: patch.setattr(drawing, "symbol", partial(drawing.symbol, rotation=3))),
}


@pytest.mark.parametrize("change", CHANGES)
def test_a_change_of_the_drawing_code_fails(tree, monkeypatch, change):
    """The tables are equal, so that the check compares the picture of the build."""
    figure, apply = CHANGES[change]
    apply(monkeypatch)
    tree.redraw(figure)
    verdict = tree.verdict(figure)
    assert verdict["status"] == "failed"
    assert "drawn from the reference tables" in verdict["reasons"][0]


def test_a_change_of_the_drawing_code_fails_even_if_numbers_differ_within_their_limits(tree, monkeypatch):
    """The tables differ, so that the check draws the table of the reference and compares this picture."""
    shift(tree, 5e-10)
    assert tree.verdict("fig10_04")["status"] == "passed"
    monkeypatch.setitem(style.UNSTABLE, "linestyle", "-")
    assert tree.verdict("fig10_04")["reasons"][-1] == DIFFERS.format("png, pdf, svg")
    monkeypatch.setattr(fig10_04, "draw_branches", lambda axes, table, panel: axes.set_xlim(0.0, float("nan")))
    assert "cannot be read or drawn" in tree.verdict("fig10_04")["reasons"][0]


@pytest.mark.parametrize("kind", ["pdf", "svg"])
def test_a_change_of_one_vector_file_alone_fails(tree, kind):
    """The test changes the checksum in the reference set, in place of the drawing code for one kind of file."""
    known = json.loads((tree.reference / SUMS).read_text())
    known["fig10_04"][kind] = "0" * 64
    (tree.reference / SUMS).write_text(json.dumps(known))
    assert tree.verdict("fig10_04")["reasons"] == [DIFFERS.format(kind)]


def test_a_change_of_one_pixel_of_the_reference_picture_fails(tree):
    change_pixel(tree.reference / "fig10_04.png")
    assert tree.verdict("fig10_04")["reasons"] == [DIFFERS.format("png")]


def test_pictures_of_other_library_versions_that_draw_the_same_pass(tree, monkeypatch):
    """Versions of other libraries, such as NumPy, are not recorded in the reference set."""
    known = json.loads((tree.reference / SUMS).read_text())
    assert set(known["fig10_04"]["drawn with"]) == {"matplotlib", "freetype"}
    change_versions(monkeypatch)
    assert tree.verdict("fig10_04")["status"] == "passed"
    shift(tree, 5e-10)  # now the check draws the table of the reference
    assert tree.verdict("fig10_04")["status"] == "passed"


def test_if_other_library_versions_draw_differently_only_numbers_are_compared(tree, monkeypatch):
    change_versions(monkeypatch)
    monkeypatch.setitem(style.STABLE, "linewidth", 2.0)
    tree.redraw("fig10_04")
    verdict = tree.verdict("fig10_04")
    assert (verdict["status"], verdict["reasons"]) == ("not comparable", [])
    assert "other library versions" in lines([verdict])[0]
    assert not has_failed([verdict])
    assert has_failed([verdict], strict=True)
    shift(tree, 1e-8)
    assert tree.verdict("fig10_04")["status"] == "failed"


def change_versions(monkeypatch):
    monkeypatch.setattr(checks, "drawing_versions", lambda: {"matplotlib": "3.11.2", "freetype": "9.9"})


# Files of a build


def shift(tree, by):
    """Add a number to the manifold of figure 10.4 in the build, and redraw the picture."""
    tree.change("fig10_04.csv", B=lambda table: table["B"] + by)


def change_pixel(path):
    with Image.open(path) as picture:
        changed = picture.convert("RGB")
    changed.putpixel((5, 5), (254, 255, 255))
    changed.save(path, "PNG")


def remove_dashes(path):
    """Make dashed lines solid in the content stream of a PDF."""
    content = path.read_bytes()
    for stream in re.findall(rb"stream\n(x.*?)\nendstream", content, re.DOTALL):
        solid = re.sub(rb"\[[\d. ]+\] ?[\d.]+ d", b"[] 0 d", zlib.decompress(stream))
        content = content.replace(stream, zlib.compress(solid))
    assert content != path.read_bytes()
    path.write_bytes(content)


def append_object(path):
    """Append another content object to a PDF, as editors do."""
    more = b"\n99 0 obj\n<< /Length 12 >>\nstream\n0 0 1 1 re f\nendstream\nendobj"
    path.write_bytes(path.read_bytes().replace(b"\nxref", more + b"\nxref"))


def truncate(path):
    path.write_bytes(path.read_bytes()[:1000])


MODIFICATIONS = [("png", change_pixel), ("pdf", remove_dashes), ("pdf", append_object)]
MODIFICATIONS += [(kind, truncate) for kind in ("png", "svg", "pdf")]


@pytest.mark.parametrize(("kind", "modify"), MODIFICATIONS)
def test_a_modified_or_truncated_picture_of_a_build_fails(tree, kind, modify):
    path = tree.results / f"fig10_04.{kind}"
    modify(path)
    verdict = tree.verdict("fig10_04")
    assert verdict["status"] == "failed"
    assert verdict["reasons"] == [DIFFERS.format(kind)] or "cannot be read or drawn" in verdict["reasons"][0]


@pytest.mark.parametrize(("by", "status"), [(0.001, "failed"), (1e-7, "passed")])
def test_coordinates_of_an_svg_must_agree_to_a_thousandth_of_a_point(tree, by, status):
    def moved(match):
        return f"L {float(match[1]) + by:.9f}"

    path = tree.results / "fig10_04.svg"
    path.write_text(re.sub(r"L (\d+\.\d{4,})", moved, path.read_text(), count=1))
    assert tree.verdict("fig10_04")["status"] == status


@pytest.mark.parametrize("name", ["fig10_04.csv", "fig10_04.svg"])
def test_missing_files_of_build_and_reference_are_named(tree, name):
    (tree.results / name).unlink()
    assert tree.verdict("fig10_04")["reasons"] == [f"not built: {name}"]
    for path in tree.reference.glob("fig10_04.*"):
        path.unlink()
    assert tree.verdict("fig10_04")["reasons"][0] == "no reference: fig10_04.png, fig10_04.csv"


@pytest.mark.parametrize("content", [b"", b"\x00\xff", b"panel,series\n\x80\x81,1\n"])
def test_an_unreadable_table_fails_only_its_figure(tree, content):
    (tree.results / "fig10_04.csv").write_bytes(content)
    assert tree.verdict("fig10_04")["status"] == "failed"
    assert tree.verdict("fig10_06")["status"] == "passed"


# Numbers


@pytest.mark.parametrize(("by", "status"), [(5e-10, "passed"), (3e-9, "failed")])
def test_a_number_may_differ_by_up_to_its_limit(tree, by, status):
    shift(tree, by)
    verdict = tree.verdict("fig10_04")
    assert verdict["status"] == status
    json.dumps(verdict, allow_nan=False)
    least = tables.read(tree.reference / "fig10_04.csv")["B"].abs().min()
    assert verdict["distance"] == pytest.approx(by / (1e-9 * (1 + least)), rel=1e-5)
    assert [r for r in verdict["reasons"] if not r.startswith("fig10_04.csv: B is off by ")] == []


def test_a_second_table_is_compared_too(tree):
    column = "amplitude variation"
    tree.change("fig10_11.statistics.csv", **{column: lambda table: 1.001 * table[column]})
    assert tree.verdict("fig10_11")["reasons"][0].startswith("fig10_11.statistics.csv: amplitude variation is off by")


# Points read from the printed figures


def write_published_points(tree, above=0.0, **columns):
    """Write three points between rows of figure 10.4: two on the manifold (10.16), one at or above B_min (10.25)."""
    rho = 2 * (1 - 0.65) / (np.pi * (1 + 0.65))
    C, series = np.array([0.5512, 1.1313, 1.5151]), ["SIM unstable", "SIM stable", "B_min"]
    B = np.append(np.sqrt(1 - 2 * C + (1 + rho**2) * C**2)[:2], rho / np.sqrt(1 + rho**2) + above)
    (tree.reference / "published").mkdir(exist_ok=True)
    table = tables.curve("SIM", series, C=C, B=B, tolerance=0.01).assign(**columns)
    tables.write(table, tree.reference / "published/fig10_04.csv")


def test_points_of_a_printed_figure_must_lie_on_the_built_curve(tree):
    write_published_points(tree)
    verdict = tree.verdict("fig10_04")
    assert (verdict["status"], verdict["reasons"]) == ("passed", [])
    assert verdict["tables"][-1]["table"] == "published/fig10_04.csv"
    assert verdict["distance"] < 0.01
    height = np.ptp(tables.read(tree.reference / "fig10_04.csv")["B"])
    write_published_points(tree, above=0.024 * height)
    verdict = tree.verdict("fig10_04")
    assert (verdict["status"], verdict["distance"]) == ("failed", pytest.approx(2.4))
    assert verdict["reasons"][0].startswith("published/fig10_04.csv: C, B is off by 2.4 times its tolerance: 1.5151, ")


@pytest.mark.parametrize(
    ("columns", "reason"),
    [
        ({"series": ["SIM stable", "B_min", "B_max"]}, "the point should name a panel, an existing curve"),
        ({"panel": ""}, "a panel"),
        ({"tolerance": [0.01, np.nan, 0.01]}, "a tolerance above 0"),
        ({"tolerance": 0.0}, "a tolerance above 0"),
        ({"D": 1.0}, "unknown columns D"),
    ],
)
def test_invalid_points_of_a_printed_figure_fail_with_a_reason(tree, columns, reason):
    write_published_points(tree, **columns)
    verdict = tree.verdict("fig10_04")
    assert verdict["status"] == "failed"
    assert reason in " ".join(verdict["reasons"])


# Faults of build and reference alike


def test_a_blank_picture_fails(tree, monkeypatch):
    monkeypatch.setattr(fig10_02, "draw", lambda: Figure())
    tree.redraw("fig10_02")
    assert "picture: blank" in tree.verdict("fig10_02")["reasons"]


# Messages


def test_figures_that_the_config_lacks_fail_and_messages_start_with_the_largest_distance(tree):
    shift(tree, 1e-8)
    write_published_points(tree)
    (tree.reference / "published/fig10_04.csv").rename(tree.reference / "published/fig10_4.csv")
    missing = check_all({}, tree.reference, tree.build)
    assert [one["figure"] for one in missing] == sorted([*FIGURES, "fig10_4"])
    assert {one["reasons"][0] for one in missing} == {"not built: the config has no figure of this name"}
    messages = lines([tree.verdict(figure) for figure in FIGURES[1:3]])
    assert messages[0].startswith("fig10_04: failed: fig10_04.csv: B is off by ")
    assert re.fullmatch(r"2 figures: 1 failed, 1 passed; largest distance [\d.]+ times its limit", messages[-1])


def test_the_page_shows_every_figure_and_the_difference_of_failed_ones(tree):
    tree.change("fig10_04.csv", B=lambda table: 1.05 * table["B"])
    text = page([tree.verdict(figure) for figure in FIGURES], tree.reference, tree.build)
    assert text.index('id="fig10_04"') < text.index('id="fig10_06"')
    assert text.count("<figcaption>Difference<") == 1
    assert text.count("picture drawn from the reference tables is identical.") == len(FIGURES) - 1
    assert 'FIGURES="fig10_04"' in text
    assert "http://" not in text.replace("http://www.w3.org", "")


def test_the_picture_of_a_difference_is_dark_around_changed_pixels():
    old, new = (Image.new("RGBA", (40, 40), "white") for _ in range(2))
    for one in (old, new):
        one.putpixel((30, 30), (0, 0, 0, 255))
    old.putpixel((5, 5), (0, 0, 0, 255))
    new.putpixel((20, 5), (0, 0, 0, 255))
    picture = pictures.load_png(difference(old, new))
    assert [picture.getpixel(place)[:3] for place in ((5, 5), (7, 5), (20, 5))] == [(0, 0, 0)] * 3
    assert [picture.getpixel(place)[:3] for place in ((30, 30), (12, 5))] == [(255, 255, 255)] * 2
