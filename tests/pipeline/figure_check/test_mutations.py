"""The figure check, one mutation after another: each leaves a figure that a reader would take for wrong."""

import io
import json
import shutil

import numpy as np
import pytest
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from PIL import Image

from checking import LIMITS, assert_caught
from vibroimpact.figures.kit import style
from vibroimpact_pipeline.figure_check.compare import check

FIGURES = ["fig10_04", "fig10_08"]


def each_axes(change):
    return lambda figure: [change(axes) for axes in figure.axes]


def each_line(change):
    return each_axes(lambda axes: [change(line) for line in axes.lines])


STYLES = {
    "grid": (each_axes(lambda axes: axes.grid(True)), "grid 1: "),
    "pink axes": (each_axes(lambda axes: axes.set_facecolor("pink")), "background 1: #ffc0cbff instead of #ffffffff"),
    "pink figure": (lambda figure: figure.set_facecolor("pink"), "figure, background 1: #ffc0cbff instead of"),
    "no background": (lambda figure: figure.patch.set_visible(False), "figure, background: none instead of"),
    "red label": (lambda figure: figure.axes[-1].xaxis.label.set_color("red"), "colour: #ff0000ff instead of"),
    "larger label": (lambda figure: figure.axes[-1].yaxis.label.set_size(10.1), "size: 10.1 instead of 10.0"),
    "red ticks": (each_axes(lambda axes: axes.tick_params(color="red")), "colour: #ff0000ff instead of #000000ff"),
    "red numbers": (each_axes(lambda axes: axes.tick_params(labelcolor="red")), "lettering 1, colour: #ff0000ff"),
    "smaller numbers": (each_axes(lambda axes: axes.tick_params(labelsize=8.4)), "size: 8.4 instead of 8.5"),
    "ticks outside": (each_axes(lambda axes: axes.tick_params(direction="out")), "marks 1 1 1, mark: "),
    "minor ticks": (each_axes(lambda axes: axes.minorticks_on()), "marks 2: "),
    "red spine": (each_axes(lambda axes: axes.spines["top"].set_color("red")), "spines, top, colour: #ff0000ff"),
    "no spine": (each_axes(lambda axes: axes.spines["top"].set_visible(False)), "spines, top: nothing instead of"),
    "no frame": (each_axes(lambda axes: axes.set_frame_on(False)), "background: none instead of"),
    "pale lines": (each_line(lambda line: line.set_alpha(0.6)), "99 instead of #"),
    "thick markers": (each_line(lambda line: line.set_markeredgewidth(3)), "marker edge: 3.0 instead of"),
    "red title": (each_axes(lambda axes: axes.set_title("a", loc="left", color="red")), "titles"),
    "watermark": (lambda figure: figure.text(0.5, 0.5, "draft"), "texts: 1 (draft) instead of nothing"),
    "stroke across": (lambda figure: figure.add_artist(Line2D([0, 1], [0, 1])), "others: ['Line2D'] instead of"),
    "arrow": (each_axes(lambda axes: axes.annotate("", (0, 0), (1, 1), arrowprops={})), "texts: "),
}
"""What is changed in a drawn figure, and what the verdict says; numbers and, here, pixels stay as they are."""


@pytest.mark.parametrize("name", FIGURES)
@pytest.mark.parametrize("mutation", STYLES)
def test_another_style_is_caught(figures, computed, verdict_without_pixels, name, mutation):
    change, said = STYLES[mutation]
    drawn = figures[name].draw(computed[name])
    change(drawn)
    assert_caught(verdict_without_pixels(name, computed[name], drawn), said)


@pytest.mark.parametrize(
    ("change", "said"),
    [
        (lambda legend: legend.set_frame_on(True), "legend, frame: "),
        (lambda legend: legend.get_texts()[0].set_color("red"), "lettering, colour: #ff0000ff"),
        (lambda legend: legend.get_texts()[0].set_alpha(0.5), "lettering, colour: #00000080"),
        (lambda legend: legend.set_title("branches"), "legend, title: 1 (branches) instead of nothing"),
    ],
)
def test_another_legend_is_caught(figures, computed, verdict_without_pixels, change, said):
    drawn = figures["fig10_04"].draw(computed["fig10_04"])
    change(drawn.axes[0].get_legend())
    assert_caught(verdict_without_pixels("fig10_04", computed["fig10_04"], drawn), said)


@pytest.fixture
def new(reference, tmp_path):
    """A folder with the files of a figure as they are in the reference."""

    def copied(name):
        for path in reference.glob(f"{name}.*"):
            shutil.copy(path, tmp_path)
        return tmp_path

    return copied


def tinted(pixels):
    """White becomes pink."""
    return np.where(pixels == 255, np.uint8([255, 192, 203]), pixels)


def reddened(pixels):
    """Black becomes red in a strip at the lower edge, where an axis has its label."""
    red = pixels.copy()
    red[-120:, :, 0] = 255
    return red


def paled(pixels):
    """All ink at 60 % opacity."""
    return (255 - 0.6 * (255.0 - pixels)).astype(np.uint8)


def holed(pixels):
    """White becomes transparent."""
    return np.dstack([pixels, np.where(pixels.min(axis=-1) == 255, 0, 255).astype(np.uint8)])


@pytest.mark.parametrize("name", [*FIGURES, "fig10_06"])
@pytest.mark.parametrize("mutation", [tinted, reddened, paled, holed])
def test_other_pixels_are_caught_where_numbers_and_artists_are_the_same(new, reference, name, mutation):
    path = new(name) / f"{name}.png"
    with Image.open(path) as picture:
        pixels = np.asarray(picture.convert("RGB"))
    Image.fromarray(mutation(pixels)).save(path, compress_level=1)
    assert_caught(check(name, reference, path.parent, LIMITS), "picture: ")


@pytest.mark.parametrize("other", ["fig10_05", "blank"])
def test_a_wholly_wrong_picture_is_caught_whatever_versions_drew_it(new, reference, other):
    folder = new("fig10_04")
    artists = folder / "fig10_04.artists.json"
    content = json.loads(artists.read_text())
    artists.write_text(json.dumps(content | {"drawn with": {"matplotlib": "9.9", "freetype": "9.9"}}))
    assert check("fig10_04", reference, folder, LIMITS)["status"] == "not comparable"
    picture = folder / "fig10_04.png"
    if other == "blank":
        with Image.open(picture) as kept:
            Image.new("L", kept.size, 255).save(picture)
    else:
        shutil.copy(reference / f"{other}.png", picture)
    found = check("fig10_04", reference, folder, LIMITS)
    assert_caught(found, "of all squares of 4 pixels are darker or lighter by more than half")


def blank_page():
    content = io.BytesIO()
    Figure((238.11 / 72, 158.74 / 72)).savefig(content, format="pdf")
    return content.getvalue()


@pytest.mark.parametrize(
    ("kind", "spoil", "said"),
    [
        ("pdf", lambda content: b"", "pdf: unreadable: "),
        ("pdf", lambda content: content[: len(content) // 2], "pdf: "),
        ("pdf", lambda content: blank_page(), "pdf: lacks the letters "),
        ("pdf", lambda content: blank_page(), "pdf, against the PNG: a square of 4 pixels is darker or lighter by 1"),
        ("svg", lambda content: b"", "svg: unreadable: "),
        ("svg", lambda content: content[: len(content) // 2], "svg: unreadable: "),
        ("svg", lambda content: b'<svg xmlns="http://www.w3.org/2000/svg"/>', "svg: "),
        ("svg", lambda content: content.replace(b"stroke: #000000", b"stroke: #ff0000"), "svg, against the PNG: "),
        ("svg", lambda content: content.replace(b"fill: #ffffff", b"fill: #ffc0cb"), "svg, against the PNG: "),
        ("svg", lambda content: content.replace(b'width="238', b'width="338', 1), "svg: "),
    ],
)
def test_a_pdf_or_svg_that_does_not_show_the_figure_is_caught(new, reference, kind, spoil, said):
    path = new("fig10_04") / f"fig10_04.{kind}"
    path.write_bytes(spoil(path.read_bytes()))
    assert_caught(check("fig10_04", reference, path.parent, LIMITS), said)


@pytest.mark.parametrize("kind", ["pdf", "svg"])
@pytest.mark.parametrize(
    "change",
    [
        lambda figure: figure.axes[-1].set_xlabel("$t$ [s]"),
        lambda figure: figure.axes[-1].lines[0].set_visible(False),
    ],
)
def test_a_pdf_or_svg_with_another_label_or_without_a_line_is_caught(
    figures, computed, new, reference, tmp_path, kind, change
):
    folder = new("fig10_08")
    drawn = figures["fig10_08"].draw(computed["fig10_08"])
    change(drawn)
    style.save(drawn, {kind: folder / f"fig10_08.{kind}"})
    assert_caught(check("fig10_08", reference, folder, LIMITS), kind)


@pytest.mark.parametrize("lost", ["pdf", "svg"])
def test_a_missing_pdf_or_svg_is_a_failure(new, reference, lost):
    folder = new("fig10_04")
    (folder / f"fig10_04.{lost}").unlink()
    assert check("fig10_04", reference, folder, LIMITS)["reasons"] == [f"not built: fig10_04.{lost}"]
