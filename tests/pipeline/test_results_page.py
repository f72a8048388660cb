"""The page of results that a build leaves."""

import pytest

from vibroimpact_pipeline.results_page import page

PAGE = "<p><strong>The exact system:</strong> <strong>a</strong>: <strong>unstable</strong>.</p>"
FILES = {
    "figures/fig10_06.png": "",
    "figures/fig10_06.svg": "",
    "figures/fig10_06.csv": "",
    "figures/mine.png": "",
    "notebooks/fig10_06.html": PAGE,
    "sweeps/coupling.html": "",
    "fixed_points.csv": "",
    "claims.json": '[{"verdict": "holds"}, {"verdict": "<refuted>"}]',
}


@pytest.fixture
def results(tmp_path):
    for name, text in FILES.items():
        add(tmp_path / name, text)
    return tmp_path


def add(path, text):
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text)


def test_the_page_of_results_links_what_is_there_with_its_exact_line(results):
    html = page(
        results,
        {"The chapter": {"fig10_06": "Points & <planes>", "fig10_07": "Not made"}, "More": {"mine": "Beside it"}},
    )
    assert "Points &amp; &lt;planes&gt;" in html
    assert PAGE.removeprefix("<p>").removesuffix("</p>") in html
    assert 'href="figures/mine.png"' in html
    assert '<img src="figures/fig10_06.svg"' in html
    assert html.index("The chapter") < html.index("Points &amp;") < html.index("More") < html.index("Beside it")
    assert 'href="report/index.html"' in html
    assert "Not made" not in html
    assert "2 claims of the chapter" in html
    assert "&lt;refuted&gt; 1" in html
    assert "<script" not in html


def test_misprints_are_counted_last_however_many_they_are(results):
    add(results / "claims.json", '[{"verdict": "misprint"}, {"verdict": "misprint"}, {"verdict": "refuted"}]')
    html = page(results, {})
    assert "refuted 1, misprint 2." in html
