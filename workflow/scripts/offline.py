"""Executed notebooks as HTML pages that read offline: formulas become MathML, nothing is fetched from anywhere."""

from pathlib import Path

from math_core import LatexToMathML
from nbconvert import HTMLExporter
from nbconvert.filters import markdown_mistune
from traitlets.config import Config

TEMPLATES = Path(__file__).resolve().parent.parent / "templates"


MATHEMATICS = LatexToMathML(fancy_error=False)


class MathMLRenderer(markdown_mistune.IPythonRenderer):
    """Markdown to HTML with formulas as MathML, which browsers draw by themselves.

    A formula that cannot be translated raises math_core.LatexError.
    """

    def inline_math(self, body):
        return MATHEMATICS.convert_with_local_state(body, displaystyle=False)

    def block_math(self, body):
        numbered = r"\tag" in body
        formula = rf"\begin{{equation}}{body}\end{{equation}}" if numbered else body
        return MATHEMATICS.convert_with_local_state(formula, displaystyle=True)

    def latex_environment(self, name, body):
        formula = rf"\begin{{{name}}}{body}\end{{{name}}}"
        return MATHEMATICS.convert_with_local_state(formula, displaystyle=True)


class OfflineExporter(HTMLExporter):
    """A notebook as one self-contained page."""

    def __init__(self, **settings):
        config = Config({"TemplateExporter": {"extra_template_basedirs": [str(TEMPLATES)]}})
        super().__init__(config=config, template_name="offline", exclude_input_prompt=True, exclude_output_prompt=True)

    def default_filters(self):
        yield from super().default_filters()
        yield "markdown2html", markdown_to_html


def markdown_to_html(source: str) -> str:
    renderer = MathMLRenderer(escape=False, exclude_anchor_links=True)
    return markdown_mistune.MarkdownWithMath(renderer=renderer).render(source)


def page(notebook, title: str) -> str:
    """The HTML page of an executed notebook."""
    html, _ = OfflineExporter().from_notebook_node(notebook, {"metadata": {"name": title}})
    return html
