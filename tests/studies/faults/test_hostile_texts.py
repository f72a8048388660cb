"""The report shows texts from the config, results and git as text, even if they contain markup or programs."""

import re

import pypdfium2 as pdfium
import pytest
from docutils.core import publish_string
from myst_parser.parsers.docutils_ import Parser

from hostile import HOSTILE, TEXTS, Markup, assert_nothing_is_live
from pipeline_trees import ROOT
from studies import hostile_results
from vibroimpact.figures.plotting.markdown import code, one_line, plain
from vibroimpact_pipeline.studies.report import site as report
from vibroimpact_pipeline.studies.report.pages import Pages, anchor, attribute, data
from vibroimpact_pipeline.studies.report.results import Results

FILLED_PAGES = sorted(path.stem for path in (ROOT / "report/pages").glob("*.md"))


def without_library(folder, left_out):
    """Write one page instead of the library reference, which has no external texts and takes most of the time."""
    folder.mkdir()
    (folder / "vibroimpact.rst").write_text("vibroimpact\n===========\n")


@pytest.fixture(scope="module")
def site(tmp_path_factory):
    """Return the folder of the pages that are filled from results; every external text in them is hostile."""
    folder = tmp_path_factory.mktemp("hostile") / "site"
    results = hostile_results.results(folder.parent / "results")
    (folder / "figures").mkdir(parents=True)
    pages = Pages(ROOT, Results(results), hostile_results.config(), hostile_results.SHOWN, [HOSTILE])
    for name in pages.about:
        (folder / f"figures/{name}.svg").write_text(hostile_results.PICTURE)
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(report, "write_library", without_library)
        report.write_site(folder, ROOT, pages, HOSTILE, HOSTILE)
    report.write_article(folder, ROOT, pages, HOSTILE, HOSTILE)
    return folder


@pytest.mark.parametrize("page", FILLED_PAGES)
def test_a_page_of_the_report_shows_texts_as_texts(site, page):
    text = (site / f"{page}.html").read_text(encoding="utf-8")
    markup, article = Markup(text), Markup(text[text.index("<article") : text.index("</article>")])
    assert_nothing_is_live(markup, scripts=1)  # the script of the theme
    assert markup.text.count(one_line(HOSTILE)) >= 2  # differences from the chapter, and source of the build
    if page in ("accuracy", "data", "figures", "fixed_points", "play"):
        assert one_line(HOSTILE) in article.text


def test_the_article_shows_texts_as_texts(site):
    """Typst would run a program in a text; this one would fail, since the file that it reads does not exist."""
    first = pdfium.PdfDocument(site / "findings.pdf")[0].get_textpage().get_text_bounded()
    assert "#read('x')" in first


@pytest.mark.parametrize(("written", "line", "tag"), [(plain, "| {} |", "td"), (code, "{}\n", "p")])
def test_sphinx_shows_any_text_unchanged(written, line, tag):
    """`plain` is tested in a table cell, where a text may not contain a line break or a separator of cells."""
    lines = "\n".join(line.format(written(text)) for text in TEXTS)
    settings = {f"myst_{name}": report.SPHINX[f"myst_{name}"] for name in ("enable_extensions", "disable_syntax")}
    source = f"# Here\n\n{'| head |' if tag == 'td' else ''}\n{'| --- |' if tag == 'td' else ''}\n{lines}\n"
    page = publish_string(source, parser=Parser(), writer="html5", settings_overrides=settings).decode()
    shown = re.findall(rf"<{tag}\b[^>]*>(.*?)</{tag}>", page, re.DOTALL)
    assert [" ".join(Markup(text).text.split()) for text in shown] == [one_line(text) for text in TEXTS]


def test_hostile_values_cannot_leave_attributes_anchors_and_data():
    assert Markup(f'<p title="{attribute(HOSTILE)}">').elements == [("p", {"title": one_line(HOSTILE)})]
    assert re.fullmatch(r"[\w-]+", anchor(HOSTILE))
    assert data("a", '{"a": "</script>"}').count("<") == 2
    with pytest.raises(ValueError, match="Expecting"):
        data("a", "</script><script>")


def test_a_browser_runs_the_scripts_of_the_report_and_no_other(browser, site):
    browser.open((site / "fixed_points.html").as_uri())
    assert browser.problems == []
    assert browser.run("document.title") != "taken"
    assert [url for url in browser.requests if not url.startswith((site.as_uri(), "data:"))] == []
    assert browser.run("getComputedStyle(document.querySelector('.skip-to-content')).position") == "fixed"
    drawn = browser.run("[...document.querySelectorAll('.play svg')].map(e => e.innerHTML.length)")
    assert drawn
    assert all(length > 3 for length in drawn)
