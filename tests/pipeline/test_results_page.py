"""Test the index page of the results of a build."""

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
    "claims.json": '[{"verdict": "misprint"}, {"verdict": "misprint"}, {"verdict": "<refuted>"}]',
}


@pytest.fixture
def results(tmp_path):
    for name, text in FILES.items():
        add(tmp_path / name, text)
    return tmp_path


def add(path, text):
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text)


def test_the_page_links_existing_results_and_shows_the_exact_verdicts(results):
    html = page(
        results,
        {"The chapter": {"fig10_06": "Points & <planes>", "fig10_07": "Not built"}, "More": {"mine": "Own figure"}},
    )
    assert "Points &amp; &lt;planes&gt;" in html
    assert PAGE.removeprefix("<p>").removesuffix("</p>") in html
    assert 'href="figures/mine.png"' in html
    assert '<img src="figures/fig10_06.svg"' in html
    assert html.index("The chapter") < html.index("Points &amp;") < html.index("More") < html.index("Own figure")
    assert 'href="report/index.html"' in html
    assert "Not built" not in html
    assert "3 claims of the chapter" in html
    assert "&lt;refuted&gt; 1, misprint 2." in html  # misprints come last
    assert "<script" not in html


def test_large_accuracy_charts_follow_the_table_of_recommended_methods(results):
    add(results / "accuracy/work_precision.svg", "")
    rows = "p,1e-06,1,<a>,x,2.6e-06,0,24\np,1e-06,2,b,x,8e-06,3,24\n"
    add(results / "accuracy/choices.csv", f"problem,error,choice,method,setting,seconds_per_cycle,wrong,tests\n{rows}")
    html = page(results, {"Speed and accuracy": {"work_precision": "Chart"}})
    row = "<tr><td>p<td>10<sup>−6</sup><td>&lt;a&gt;, 2.6 µs; silently wrong in 0 of 24 stress tests<td>b, 8 µs;"
    assert html.index(row) < html.index('class="figures large"') < html.index("accuracy/work_precision.svg")
