"""Convert executed notebooks to offline HTML pages with MathML formulas."""

import re
from html import escape
from pathlib import Path

from nbconvert import HTMLExporter
from nbconvert.filters import markdown_mistune
from traitlets.config import Config

from vibroimpact_pipeline.html.mathematics import STYLE, kept, mathml
from vibroimpact_pipeline.html.policy import guarded

PROGRESS = "vibroimpact: compiling"
"""Prefix of the library's progress messages, which are omitted from pages."""
PAGE = Path(__file__).with_name("notebook.html.j2")


class MathMLRenderer(markdown_mistune.IPythonRenderer):
    """Render Markdown as HTML with MathML formulas.

    Formulas that cannot be converted raise math_core.LatexError.
    """

    def inline_math(self, body):
        return mathml(body, display=False)

    def block_math(self, body):
        return mathml(body, display=True)

    def latex_environment(self, name, body):
        return mathml(rf"\begin{{{name}}}{body}\end{{{name}}}", display=True)


class OfflineExporter(HTMLExporter):
    """Export a notebook as one self-contained page."""

    def __init__(self):
        # Omit default parameters, which Papermill overrides, and instructions for running the notebook.
        config = Config(TagRemovePreprocessor={"enabled": True, "remove_cell_tags": {"parameters", "instructions"}})
        super().__init__(config=config, exclude_input_prompt=True, exclude_output_prompt=True)
        self.raw_template = PAGE.read_text(encoding="utf-8")

    def default_filters(self):
        yield from super().default_filters()
        yield "markdown2html", markdown_to_html


def markdown_to_html(source: str) -> str:
    """Convert Markdown of a notebook to HTML; raw HTML is escaped, and links with unsafe protocols are removed."""
    renderer = MathMLRenderer(escape=True, allow_harmful_protocols=False, exclude_anchor_links=True)
    return kept(markdown_mistune.MarkdownWithMath(renderer=renderer).render(source))


def linked(page: str, address: str) -> str:
    """Return a notebook page for the report.

    Links to Markdown documents are replaced by links to the HTML pages of the report. The line "Notebook of ..."
    becomes a link to `address`.
    """
    page = re.sub(r'href="\.\./(?:\.\./docs/)?(\w+)\.md"', r'href="../\1.html"', page)
    return re.sub(r'(<p class="of">)(.*?)(</p>)', rf'\1<a href="{escape(address)}">\2</a>\3', page, count=1)


def page(notebook, title: str) -> str:
    """Return the HTML page of an executed notebook, without messages about compiling."""
    for cell in notebook.cells:
        if "outputs" in cell:
            cell.outputs = [output for output in cell.outputs if not output.get("text", "").startswith(PROGRESS)]
    html, _ = OfflineExporter().from_notebook_node(notebook, {"metadata": {"name": title}, "mathematics": STYLE})
    beside_results = html.replace('href="../docs/', 'href="../../docs/').replace('href="../results/', 'href="../')
    return guarded(beside_results)
