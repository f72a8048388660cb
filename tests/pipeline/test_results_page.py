"""The page to open first, and the page of results."""

import os

import pytest

from vibroimpact_pipeline import results_page

PAGE = "<p><strong>The exact system:</strong> <strong>a</strong>: <strong>unstable</strong>.</p>"
FILES = {
    "figures/fig10_06.png": "",
    "figures/fig10_06.csv": "",
    "figures/companion.png": "",
    "notebooks/fig10_06.html": PAGE,
    "sweeps/coupling.html": "",
    "fixed_points.csv": "",
    "claims.json": '[{"verdict": "holds"}, {"verdict": "<refuted>"}]',
    "index.html": "",
}


@pytest.fixture
def results(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    for name, text in FILES.items():
        add(name, text)
    return tmp_path / "results"


def add(name, text="", minutes=0):
    """A file of results that is so many minutes older than the others."""
    path = results_page.RESULTS / name
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text)
    os.utime(path, (1e9 - 60 * minutes,) * 2)


@pytest.mark.parametrize(
    ("targets", "page"),
    [
        (["all"], "results/index.html"),
        (["figures"], "results/index.html"),
        (["snakemake", "--cores", "2"], "results/index.html"),
        (["fig10_06"], "results/notebooks/fig10_06.html"),
        (["sweep_coupling"], "results/sweeps/coupling.html"),
        (["figure_check"], "results/index.html"),  # it has left no page
    ],
)
def test_a_target_with_a_page_has_it_opened_and_others_the_index(results, targets, page):
    assert results_page.first_page(targets) == page


def test_the_report_comes_first_while_it_is_of_these_results(results):
    add("report/index.html")
    assert results_page.first_page(["all"]) == "results/report/index.html"
    add("report/index.html", minutes=1)
    assert results_page.first_page(["all"]) == "results/index.html"
    assert results_page.first_page(["report"]) == "results/report/index.html"


def test_without_a_page_none_is_named(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    assert results_page.first_page(["all"]) is None


def test_the_page_of_results_links_what_is_there_with_its_exact_line(results):
    results_page.write({"fig10_06": "Points & <planes>", "companion": "Beside it", "fig10_07": "Not made"})
    html = (results / "index.html").read_text(encoding="utf-8")
    assert "Points &amp; &lt;planes&gt;" in html
    assert PAGE.removeprefix("<p>").removesuffix("</p>") in html
    assert 'href="figures/companion.png"' in html
    assert "Not made" not in html
    assert "2 claims of the chapter" in html
    assert "&lt;refuted&gt; 1" in html
    assert "<script" not in html


def test_misprints_are_counted_last_however_many_they_are(results):
    add("claims.json", '[{"verdict": "misprint"}, {"verdict": "misprint"}, {"verdict": "refuted"}]')
    results_page.write({})
    html = (results / "index.html").read_text(encoding="utf-8")
    assert "refuted 1, misprint 2." in html
