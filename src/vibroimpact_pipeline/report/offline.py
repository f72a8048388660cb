"""Executed notebooks as HTML pages that read offline: formulas become MathML, nothing is fetched from anywhere."""

import re
from html import escape

from nbconvert import HTMLExporter
from nbconvert.filters import markdown_mistune
from traitlets.config import Config

from vibroimpact_pipeline.report.mathematics import STYLE, kept, mathml
from vibroimpact_pipeline.report.policy import guarded

PAGE = """\
{#- A page that needs nothing but itself: no script, no font and no style from elsewhere. -#}
{%- extends 'classic/base.html.j2' -%}
{%- block header -%}
<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>{{ resources.metadata.name | escape_html }}</title>
<style>
{% for css in resources.inlining.css %}{{ css }}{% endfor %}
{{ resources.mathematics }}
body { max-width: 50rem; margin: 2rem auto; padding: 0 1rem; color: #111; }
body { font: 1.05rem/1.55 Georgia, serif; font-size-adjust: 0.48; }
h1, h2, h3 { line-height: 1.2; }
pre, code { font: 0.85rem/1.4 monospace; }
.input_area, .output_area { overflow-x: auto; }
.input_area { background: #f6f6f6; padding: 0.1rem 0.8rem; }
.input_area pre { white-space: pre-wrap; overflow-wrap: anywhere; }
summary { cursor: pointer; font: 0.9rem system-ui, sans-serif; padding: 0.3rem 0; }
.of { font: 0.9rem system-ui, sans-serif; border-bottom: 1px solid #ccc; padding-bottom: 0.6rem; }
/* Beside a numbered formula the margins share the room that is left, and the number keeps its line. */
math mtd[style*="width: 50%"] { width: auto !important; white-space: nowrap; }
img, svg { max-width: 100%; height: auto; }
table { border-collapse: collapse; font-size: 0.9rem; }
th, td { padding: 0.15rem 0.6rem; border-bottom: 1px solid #ccc; text-align: right; }
a.anchor-link { display: none; }
@media print {
  body { max-width: none; margin: 0; font-size: 10pt; }
  .input_area, .output_area { overflow: visible; }
  .output_area pre { white-space: pre-wrap; overflow-wrap: anywhere; }
  .output_area table { font-size: 7pt; }
  .output_area th, .output_area td { padding: 0.1rem 0.25rem; overflow-wrap: anywhere; }
  details::details-content { content-visibility: visible; block-size: auto; }
  img, tr { break-inside: avoid; }
  img { max-height: 110mm; width: auto; }
  h1, h2, h3, summary { break-after: avoid; }
}
</style>
</head>
<body>
<p class="of">Notebook of {{ resources.metadata.name | escape_html }}</p>
{%- endblock header -%}
{%- block input_group -%}
<details><summary>{{ "Parameters" if "injected-parameters" in cell.metadata.tags else "Code" }}</summary>
{{ super() }}
</details>
{%- endblock input_group -%}
{%- block footer %}
</body>
</html>
{% endblock footer -%}
"""


class MathMLRenderer(markdown_mistune.IPythonRenderer):
    """Markdown to HTML with formulas as MathML, which browsers draw by themselves.

    A formula that cannot be translated raises math_core.LatexError.
    """

    def inline_math(self, body):
        return mathml(body, display=False)

    def block_math(self, body):
        numbered = r"\tag" in body
        formula = rf"\begin{{equation}}{body}\end{{equation}}" if numbered else body
        return mathml(formula, display=True)

    def latex_environment(self, name, body):
        formula = rf"\begin{{{name}}}{body}\end{{{name}}}"
        return mathml(formula, display=True)


class OfflineExporter(HTMLExporter):
    """A notebook as one self-contained page."""

    def __init__(self):
        # Papermill puts the values of this run below the cell with the default parameters, which need not be read.
        config = Config(TagRemovePreprocessor={"enabled": True, "remove_cell_tags": {"parameters"}})
        super().__init__(config=config, exclude_input_prompt=True, exclude_output_prompt=True)
        self.raw_template = PAGE

    def default_filters(self):
        yield from super().default_filters()
        yield "markdown2html", markdown_to_html


def markdown_to_html(source: str) -> str:
    """HTML of the Markdown in a notebook; what looks like HTML in it is text, and no link leads to a program."""
    renderer = MathMLRenderer(escape=True, allow_harmful_protocols=False, exclude_anchor_links=True)
    return kept(markdown_mistune.MarkdownWithMath(renderer=renderer).render(source))


def linked(page: str, address: str) -> str:
    """The page of a notebook with a link from its first line to where its figure is shown."""
    return re.sub(r'(<p class="of">)(.*?)(</p>)', rf'\1<a href="{escape(address)}">\2</a>\3', page, count=1)


def page(notebook, title: str) -> str:
    """The HTML page of an executed notebook; the title is that of its figure."""
    html, _ = OfflineExporter().from_notebook_node(notebook, {"metadata": {"name": title}, "mathematics": STYLE})
    return guarded(html)
