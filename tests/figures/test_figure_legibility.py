"""Fit for print: exact widths, lettering of at least 7 points, nothing clipped, nothing on top of a label."""

import itertools

import pytest
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.text import Text

SMALLEST = 7.0
SUBSCRIPT = 0.7  # size of Matplotlib's subscripts relative to the symbol


def visible_texts(figure):
    """Texts in the picture; tick labels outside the limits and the labels of bare axes are not in it."""
    hidden = set()
    for axes in figure.axes:
        for axis, (low, high) in ((axes.xaxis, axes.get_xlim()), (axes.yaxis, axes.get_ylim())):
            ticks = axis.get_major_ticks()
            unseen = [tick for tick in ticks if not (axes.axison and low <= tick.get_loc() <= high)]
            hidden |= {label for tick in unseen for label in (tick.label1, tick.label2)}
    return [text for text in figure.findobj(Text) if text.get_visible() and text.get_text() and text not in hidden]


@pytest.fixture
def boxes(drawn, name):
    """Every visible text of the figure with its extent in pixels."""
    figure = drawn[name]
    renderer = FigureCanvasAgg(figure).get_renderer()
    return [(text, Text.get_window_extent(text, renderer)) for text in visible_texts(figure)]


def test_widths_are_those_of_a_column_or_a_page(drawn, name):
    width, height = drawn[name].get_size_inches() * 25.4
    assert width == pytest.approx(84, abs=1e-9) or width == pytest.approx(174, abs=1e-9)
    assert height < 235


def test_lettering_is_at_least_7_points(boxes):
    assert boxes
    for text, _ in boxes:
        size = text.get_fontsize() * (SUBSCRIPT if "_" in text.get_text() else 1)
        assert round(size, 9) >= SMALLEST, text.get_text()


def test_no_text_is_clipped_by_the_edge(drawn, name, boxes):
    paper = drawn[name].bbox
    for text, box in boxes:
        assert paper.x0 <= box.x0 < box.x1 <= paper.x1, text.get_text()
        assert paper.y0 <= box.y0 < box.y1 <= paper.y1, text.get_text()


def test_no_text_covers_another(boxes):
    for (one, first), (other, second) in itertools.combinations(boxes, 2):
        assert not first.padded(-0.5).overlaps(second.padded(-0.5)), (one.get_text(), other.get_text())


def test_no_label_lies_on_a_curve(drawn, name, boxes):
    """Labels inside the axes keep clear of the points of every line drawn there."""
    for text, box in boxes:
        if text.axes is None or text not in text.axes.texts:
            continue
        for line in text.axes.lines:
            path = line.get_transform().transform_path(line.get_path())
            if not drawn[name].axes[0].axison and line.get_linewidth() <= 0.5:
                continue  # centre lines of a drawing pass behind symbols nowhere else than where they are meant to
            assert not path.intersects_bbox(box.padded(-1), filled=False), text.get_text()
