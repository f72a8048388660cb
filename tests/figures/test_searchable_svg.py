"""SVG of figures: outlines as Matplotlib draws them, the same bytes every time, and words to be found over them."""

import xml.etree.ElementTree as ET

import numpy as np
import pytest

from vibroimpact.figures.kit.style import new_figure, save, styled

SVG = "{http://www.w3.org/2000/svg}"


@styled
def drawn():
    figure = new_figure(84.0, 60.0)
    axes = figure.add_subplot()
    axes.plot([0, 1], [0, 1])
    axes.set(xlabel=r"$C_{\min} < \pi$", ylabel="x & y < z", xticks=[0], yticks=[])
    axes.text(0.2, 0.5, "two\nlines", rotation=30)
    return figure


@pytest.fixture(scope="module")
def written(tmp_path_factory):
    """The same figure by this backend, twice, and by Matplotlib's own."""
    folder = tmp_path_factory.mktemp("svg")
    for name in ("one", "two"):
        save(drawn(), {"svg": folder / name})
    figure = drawn()
    styled(lambda: figure.savefig(folder / "plain", format="svg", metadata={"Date": None}))()
    return {path.name: path.read_text() for path in folder.iterdir()}


def words(text):
    return ET.fromstring(text).iter(f"{SVG}text")


def test_every_text_can_be_found(written):
    assert sorted(word.text for word in words(written["one"])) == sorted(["0", "Cmin<π", "x & y < z", "two", "lines"])
    assert not list(words(written["plain"]))


def test_what_is_seen_is_what_matplotlib_draws(written):
    """Without the words, which are transparent, the file is that of Matplotlib's own backend."""
    assert all("fill-opacity: 0" in word.get("style") for word in words(written["one"]))
    lines = [line for line in written["one"].splitlines() if not line.lstrip().startswith("<text")]
    assert lines == written["plain"].splitlines()


def test_bytes_are_the_same_every_time(written):
    assert written["one"] == written["two"]


def test_words_lie_on_their_outlines(written):
    """Where the outlines of each text begin, turned as they are."""
    parents = {child: parent for parent in ET.fromstring(written["one"]).iter() for child in parent}
    for word in (child for child in parents if child.tag == f"{SVG}text"):
        outlines = [each for each in parents[word] if each.tag == f"{SVG}g" and each.get("transform")]
        said, *drawn = (each.get("transform").split(" scale")[0] for each in (word, *outlines))
        places = [np.array(text.split("(")[1].split(")")[0].split(), float) for text in (said, *drawn)]
        off = [np.abs(places[0] - place).max() for place in places[1:]]
        assert min(off) < 0.01
        assert ("rotate(0)" in said) == ("rotate" not in drawn[np.argmin(off)])
