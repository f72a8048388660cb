"""Results in one short line, and in a small table that a notebook can show."""

from html.parser import HTMLParser

import numpy as np
import pytest

import vibroimpact as vi
from chapter import PARAMETERS
from vibroimpact.system.glance import Glance

SYSTEM = vi.System(**PARAMETERS, f10_hat=1.0, f20_hat=1.0)


class Cells(HTMLParser):
    """Tags and cells of a table."""

    def __init__(self, text):
        super().__init__()
        self.tags, self.cells = [], []
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        self.tags.append(tag)

    def handle_data(self, data):
        self.cells.append(data)


@pytest.fixture(scope="module")
def results():
    run = vi.simulate(SYSTEM, np.zeros(8), 200)
    return {
        "run": run,
        "certificate": run.certificate,
        "point": vi.fixed_points(SYSTEM)[0],
        "orbit": vi.orbits(SYSTEM)[1],
    }


@pytest.mark.parametrize("name", ["run", "certificate", "point", "orbit"])
def test_a_line_and_a_table(results, name):
    result = results[name]
    line, table = repr(result), Cells(result._repr_html_())
    assert line.startswith(f"{type(result).__name__}(")
    assert len(line) < 220
    assert "\n" not in line
    assert set(table.tags) == {"table", "caption", "tr", "th", "td"}
    title, *cells = table.cells
    assert title == type(result).__name__
    for attribute, text in zip(cells[::2], cells[1::2], strict=True):
        assert hasattr(result, attribute)
        assert f"{attribute}={text}" in line


def test_the_line_of_a_run_counts_its_events(results):
    kinds = results["run"].events["kind"]
    assert f"events={len(kinds)}: {np.sum(kinds == vi.IMPACT)} impact" in repr(results["run"])


def test_the_line_of_a_point_holds_its_amplitudes(results):
    C = results["point"].C
    assert f"C=({C[0]:.4g}, {C[1]:.4g})" in repr(results["point"])


def test_texts_are_escaped_in_the_table():
    class Odd(Glance):
        def _glance(self):
            return {"<b>": "a & b"}

    assert Cells(Odd()._repr_html_()).cells == ["Odd", "<b>", "a & b"]
