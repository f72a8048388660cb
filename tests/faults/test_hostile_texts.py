"""Test that pages of a build show texts with markup or scripts, from config, results or git, as plain text."""

import html

import nbformat
import pandas as pd
import pytest
from IPython.display import Markdown

from hostile import HOSTILE, RUN, STATEMENT, TEXTS, Markup, assert_nothing_is_live
from vibroimpact.figures.plotting.markdown import code, one_line, plain
from vibroimpact_pipeline.figure_check.page import page as check_page
from vibroimpact_pipeline.html import offline
from vibroimpact_pipeline.html.policy import guarded


def notebook(folder):
    """Return the page of an executed notebook that shows hostile texts in each kind of cell output."""
    markdown = Markdown(f"Case {code(HOSTILE)}, point **{plain(HOSTILE)}**, as it is: {STATEMENT}").data
    table = pd.DataFrame({HOSTILE: [HOSTILE]})._repr_html_()
    pixel = "iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAYAAAAfFcSJAAAADUlEQVR42mNk+M9QDwADhgGAWjR9awAAAABJRU5ErkJggg=="
    bundles = [{"text/markdown": markdown}, {"text/html": table}, {"image/png": pixel}, {"text/plain": HOSTILE}]
    new = nbformat.v4
    outputs = [new.new_output("display_data", data, metadata={"image/png": {"alt": HOSTILE}}) for data in bundles]
    outputs.append(new.new_output("stream", text=HOSTILE))
    cell = new.new_code_cell(f"case = {HOSTILE!r}", outputs=outputs)
    return offline.page(new.new_notebook(cells=[cell]), HOSTILE)


def figure_check(folder):
    """Return the page of a figure check in which all texts are hostile."""
    row = dict.fromkeys(("table", "column", "kind", "where", "reference", "new"), HOSTILE)
    verdict = {"figure": HOSTILE, "stem": HOSTILE, "status": "failed", "reasons": [HOSTILE] * 30, "distance": 1.0}
    verdict["tables"] = [row | {"measure": HOSTILE, "distance": 1.0}]
    return check_page([verdict], folder, folder)


@pytest.mark.parametrize("page_of", [notebook, figure_check])
def test_pages_show_hostile_texts_as_plain_text(page_of, tmp_path):
    markup = Markup(page_of(tmp_path))
    assert_nothing_is_live(markup)
    assert one_line(HOSTILE) in markup.text


@pytest.mark.parametrize("escape", [plain, code])
def test_escaped_texts_survive_the_conversion_from_markdown_to_html(escape):
    for text in TEXTS:
        shown = Markup(offline.markdown_to_html(f"Case {escape(text)} is"))
        assert shown.text == f"Case {one_line(text)} is"
        assert {tag for tag, _ in shown.elements} <= {"p", "code"}


def test_a_page_without_a_head_has_no_place_for_the_policy_and_is_refused():
    with pytest.raises(ValueError, match="head"):
        guarded("<p>text</p>")


ATTACKS = [
    f"<script>{RUN}</script>",
    f'<img src="data:," onerror="{RUN}">',
    f'<iframe srcdoc="{html.escape(f"<script>parent.{RUN[5:-1]}</script>")}"></iframe>',
    '<script src="attack.js"></script>',
    f'<a id="a" href="javascript:{RUN}">a</a>',
]


@pytest.mark.parametrize("attack", ATTACKS)
@pytest.mark.parametrize("policy", [True, False], ids=["with the policy", "without"])
def test_the_content_security_policy_blocks_scripts_that_were_not_escaped(browser, tmp_path, attack, policy):
    """Without the policy, each attack changes the title, so that the test detects scripts that run."""
    page = f"<!DOCTYPE html><html><head>\n<title>own</title></head><body>{attack}</body></html>"
    (tmp_path / "attack.js").write_text(RUN)
    (tmp_path / "page.html").write_text(guarded(page) if policy else page, encoding="utf-8")
    browser.open((tmp_path / "page.html").as_uri())
    browser.run("document.querySelector('#a')?.click()")
    browser.run("new Promise(done => setTimeout(done, 100))")
    assert browser.run("document.title") == ("own" if policy else "taken")
    assert any("Content Security Policy" in problem for problem in browser.problems) == policy
