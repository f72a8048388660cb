"""Texts from the config, results and git that are made to be markup or programs: every page shows them as text."""

import html
import re
from urllib.parse import urlsplit

import nbformat
import pandas as pd
import pypdfium2 as pdfium
import pytest
from docutils.core import publish_string
from IPython.display import Markdown
from myst_parser.parsers.docutils_ import Parser

import hostile
from headless_browser import Browser, executable
from hostile import HOSTILE, RUN, STATEMENT, Markup
from pipeline_trees import ROOT
from vibroimpact.figures.plotting.markdown import code, one_line, plain
from vibroimpact_pipeline.figure_check.page import page as check_page
from vibroimpact_pipeline.html.policy import guarded
from vibroimpact_pipeline.studies.report import offline
from vibroimpact_pipeline.studies.report.pages import Pages, anchor, attribute, data
from vibroimpact_pipeline.studies.report.results import Results
from vibroimpact_pipeline.studies.report.site import SPHINX, write_article, write_site

FILLED_PAGES = sorted(path.stem for path in (ROOT / "report/pages").glob("*.md"))
LIVE = ("motion", "fixed_points", "play")
DATA = {"type": "application/json"}
KINDS = ("iframe", "object", "embed", "base", "form", "marquee")
"""Elements that no page has of its own."""
MARKS = (
    "<!-- ¦ &amp; ¦ &#60;b> ¦ a\n\n# b ¦ - a ¦ 1. a ¦ > a ¦ ```\n<b>\n``` ¦ ~~~ ¦ [a]: b ¦ <http://a.b> ¦ a@b.c ¦ "
    "\\<b> ¦ \\\\(x\\\\) ¦ $x$ ¦ $$x$$ ¦ ^a^ ¦ ~a~ ¦ ::: ¦ --- ¦ a  \nb ¦ | ¦ +-+ ¦ é — ² ¦ @a [@b] ¦ [^1]"
)
TEXTS = [HOSTILE, *(HOSTILE[start : start + 25] for start in range(0, len(HOSTILE), 9)), *MARKS.split(" ¦ ")]


@pytest.fixture(scope="module")
def site(tmp_path_factory):
    """The pages that are filled from results, where every text from elsewhere is hostile."""
    folder = tmp_path_factory.mktemp("hostile") / "site"
    results = hostile.results(folder.parent / "results")
    (folder / "figures").mkdir(parents=True)
    pages = Pages(ROOT, Results(results), hostile.config(), hostile.SHOWN, [HOSTILE])
    for name in pages.about:
        (folder / f"figures/{name}.svg").write_text(hostile.PICTURE)
    write_site(folder, ROOT, pages, HOSTILE, HOSTILE)
    write_article(folder, ROOT, pages, HOSTILE, HOSTILE)
    return folder


def notebook(folder):
    """The page of an executed notebook that shows hostile texts in every way that notebooks have."""
    said = Markdown(f"Case {code(HOSTILE)}, point **{plain(HOSTILE)}**, as it is: {STATEMENT}").data
    table = pd.DataFrame({HOSTILE: [HOSTILE]})._repr_html_()
    pixel = "iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAYAAAAfFcSJAAAADUlEQVR42mNk+M9QDwADhgGAWjR9awAAAABJRU5ErkJggg=="
    bundles = [{"text/markdown": said}, {"text/html": table}, {"image/png": pixel}, {"text/plain": HOSTILE}]
    new = nbformat.v4
    outputs = [new.new_output("display_data", data, metadata={"image/png": {"alt": HOSTILE}}) for data in bundles]
    outputs.append(new.new_output("stream", text=HOSTILE))
    cell = new.new_code_cell(f"case = {HOSTILE!r}", outputs=outputs)
    return offline.page(new.new_notebook(cells=[cell]), HOSTILE)


def figure_check(folder):
    """The page of a figure check in which all texts are hostile."""
    row = dict.fromkeys(("table", "column", "kind", "where", "reference", "new"), HOSTILE)
    verdict = {
        "figure": HOSTILE,
        "status": "failed",
        "reasons": [HOSTILE] * 30,
        "distance": 1.0,
        "tables": [row | {"measure": HOSTILE, "distance": 1.0}],
    }
    return check_page([verdict], folder, folder)


def assert_nothing_is_live(markup, scripts=0):
    """No element, attribute or link but those of the page, and a policy that lets nothing else run."""
    odd = [values for tag, values in markup.elements if tag in KINDS]
    assert [values for values in odd if values.get("action") != "search.html"] == []
    programs = [values for tag, values in markup.elements if tag == "script" and not values.items() >= DATA.items()]
    assert [values for values in programs if not values.get("src", "").startswith("_static/")] == [{}] * scripts
    assert markup.programs == []
    assert {urlsplit(link).scheme for link in markup.links} <= {"", "data"}
    assert [values for tag, values in markup.elements if tag == "img" and values["src"] == "x"] == []
    assert re.search(r"script-src ('none'|'self' file: 'sha256-[^']{44}');", markup.policy)
    assert markup.policy.startswith("default-src 'none'; ")


@pytest.mark.parametrize("page", FILLED_PAGES)
def test_a_page_of_the_report_shows_texts_as_texts(site, page):
    text = (site / f"{page}.html").read_text(encoding="utf-8")
    markup, article = Markup(text), Markup(text[text.index("<article") : text.index("</article>")])
    assert_nothing_is_live(markup, scripts=1)  # that of the theme
    assert markup.text.count(one_line(HOSTILE)) >= 2  # where the build departs from the chapter, and what it is from
    if page in ("accuracy", "data", "figures", "fixed_points", "play"):
        assert one_line(HOSTILE) in article.text


def test_the_article_shows_texts_as_texts(site):
    """In Typst, too, a text could be a program, which would fail here: there is nothing for it to read."""
    first = pdfium.PdfDocument(site / "findings.pdf")[0].get_textpage().get_text_bounded()
    assert "#read('x')" in first


@pytest.mark.parametrize("made", [notebook, figure_check])
def test_other_pages_show_texts_as_texts(made, tmp_path):
    markup = Markup(made(tmp_path))
    assert_nothing_is_live(markup)
    assert one_line(HOSTILE) in markup.text


@pytest.mark.parametrize(("written", "line", "tag"), [(plain, "| {} |", "td"), (code, "{}\n", "p")])
def test_any_text_is_shown_by_sphinx_as_it_is(written, line, tag):
    """Plain also in a cell of a table, which is the narrowest place."""
    lines = "\n".join(line.format(written(text)) for text in TEXTS)
    settings = {f"myst_{name}": SPHINX[f"myst_{name}"] for name in ("enable_extensions", "disable_syntax")}
    source = f"# Here\n\n{'| head |' if tag == 'td' else ''}\n{'| --- |' if tag == 'td' else ''}\n{lines}\n"
    page = publish_string(source, parser=Parser(), writer="html5", settings_overrides=settings).decode()
    shown = re.findall(rf"<{tag}\b[^>]*>(.*?)</{tag}>", page, re.DOTALL)
    assert [" ".join(Markup(text).text.split()) for text in shown] == [one_line(text) for text in TEXTS]


@pytest.mark.parametrize("written", [plain, code])
def test_any_text_is_shown_by_a_notebook_as_it_is(written):
    for text in TEXTS:
        shown = Markup(offline.markdown_to_html(f"Case {written(text)} is"))
        assert shown.text == f"Case {one_line(text)} is"
        assert {tag for tag, _ in shown.elements} <= {"p", "code"}


def test_values_in_other_places_stay_there():
    assert Markup(f'<p title="{attribute(HOSTILE)}">').elements == [("p", {"title": one_line(HOSTILE)})]
    assert re.fullmatch(r"[\w-]+", anchor(HOSTILE))
    assert data("a", '{"a": "</script>"}').count("<") == 2
    with pytest.raises(ValueError, match="Expecting"):
        data("a", "</script><script>")


def test_a_page_without_a_head_gets_no_policy_and_is_refused():
    with pytest.raises(ValueError, match="head"):
        guarded("<p>text</p>")


@pytest.fixture(scope="module")
def browser():
    path = executable()
    if path is None:
        pytest.skip("no page was opened in a browser: there is no Chromium here (Debian: apt install chromium)")
    browser = Browser(path)
    yield browser
    browser.close()


@pytest.mark.parametrize("page", FILLED_PAGES)
def test_a_browser_runs_the_scripts_of_the_report_and_no_other(browser, site, page):
    browser.open((site / f"{page}.html").as_uri())
    assert browser.problems == []
    assert browser.run("document.title") != "taken"
    assert [url for url in browser.requests if not url.startswith((site.as_uri(), "data:"))] == []
    assert browser.run("getComputedStyle(document.querySelector('.skip-to-content')).position") == "fixed"
    drawn = browser.run(
        "[...document.querySelectorAll('.live svg, .live output, .play svg')].map(e => e.innerHTML.length)"
    )
    assert all(length > 3 for length in drawn)
    assert bool(drawn) == (page in LIVE)


def test_the_slider_moves_the_points_of_hostile_results(browser, site):
    browser.open((site / "fixed_points.html").as_uri())
    browser.run("document.querySelector('#f20').focus()")
    browser.press("End")
    assert browser.run("document.querySelector('output').textContent") == "0.50"
    assert HOSTILE in browser.run("document.querySelector('.live tbody').textContent")


@pytest.mark.parametrize("made", [notebook, figure_check])
def test_a_browser_runs_nothing_on_other_pages(browser, made, tmp_path):
    (tmp_path / "page.html").write_text(made(tmp_path), encoding="utf-8")
    browser.open((tmp_path / "page.html").as_uri())
    assert browser.problems == []
    assert browser.run("document.title") != "taken"


ATTACKS = [
    f"<script>{RUN}</script>",
    f'<img src="data:," onerror="{RUN}">',
    f'<iframe srcdoc="{html.escape(f"<script>parent.{RUN[5:-1]}</script>")}"></iframe>',
    '<script src="attack.js"></script>',
    f'<a id="a" href="javascript:{RUN}">a</a>',
]


@pytest.mark.parametrize("attack", ATTACKS)
@pytest.mark.parametrize("policy", [True, False], ids=["with the policy", "without"])
def test_what_slips_through_the_escapes_is_stopped_by_the_policy(browser, tmp_path, attack, policy):
    """Without it, every one of these takes over the page: the tests above could fail."""
    page = f"<!DOCTYPE html><html><head>\n<title>own</title></head><body>{attack}</body></html>"
    (tmp_path / "attack.js").write_text(RUN)
    (tmp_path / "page.html").write_text(guarded(page) if policy else page, encoding="utf-8")
    browser.open((tmp_path / "page.html").as_uri())
    browser.run("document.querySelector('#a')?.click()")
    browser.run("new Promise(done => setTimeout(done, 100))")
    assert browser.run("document.title") == ("own" if policy else "taken")
    assert any("Content Security Policy" in problem for problem in browser.problems) == policy
