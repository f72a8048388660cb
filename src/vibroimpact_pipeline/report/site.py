"""The site by Sphinx and the PDF by Typst, from Markdown pages; nothing is fetched."""

import html
import io
import json
import re
import shutil
from pathlib import Path
from tempfile import TemporaryDirectory

import pypandoc
import typst
from docutils import nodes
from docutils.parsers.rst import Directive
from sphinx.application import Sphinx
from sphinx.util.docutils import docutils_namespace

from vibroimpact_pipeline.report import api
from vibroimpact_pipeline.report.api import documented
from vibroimpact_pipeline.report.mathematics import STYLE as OF_MATHEMATICS
from vibroimpact_pipeline.report.mathematics import kept, mathml
from vibroimpact_pipeline.report.pages import is_template
from vibroimpact_pipeline.report.policy import guarded

READER = "markdown-fancy_lists+gfm_auto_identifiers"
"""Headings can be linked to; no list begins with "(3)": here that is an equation at the start of a paragraph."""
FILLED = READER + "-raw_html-raw_tex-native_divs-native_spans"
"""For pages that are filled from results: what looks like HTML is text there."""
FORMULA = re.compile(r'<span\s+class="math (inline|display)">\\[(\[](.*?)\\[)\]]</span>', re.DOTALL)
"""A formula as pandoc leaves it for others to set."""
HEADING = re.compile(r'^<h([1-6])[^>]* id="([^"]*)"[^>]*>(.*?)</h\1>', re.DOTALL | re.MULTILINE)
"""A heading that links can lead to: a section begins. One without a name belongs to a live piece."""
PDF = "report.pdf"
STYLE = "style.css"
OF_PAGE = re.compile(r"^(?!.*docstring of|.*<unknown>).*(WARNING|ERROR)")
"""A warning that is not about a docstring, nor about a name that is shown where it is imported, too."""
THEME_FOOTER = re.compile(r'<div class="bottom-of-page">.*?</footer>', re.DOTALL)
"""The theme's own footer, whose links lead outside."""
UNNAMED = {
    '<p class="caption" role="heading">': '<p class="caption" role="heading" aria-level="2">',
    '<aside class="sidebar-drawer">': '<aside class="sidebar-drawer" aria-label="Pages">',
    '<aside class="toc-drawer">': '<aside class="toc-drawer" aria-label="On this page">',
}
"""Names for screen readers that Sphinx and the theme leave out."""
GENERATED = re.compile(r'<script src="([^"?]+)(?:\?[^"]*)?"(?: defer(?:="defer")?)?></script>')
"""A script that Sphinx or the theme has in a file beside the page."""
INLINE = re.compile(r"<script>(.*?)</script>", re.DOTALL)


def write(folder, root, pages, settings: dict, footer: str) -> None:
    """Write the site and its PDF into a folder that has the figures already; the footer is Markdown."""
    folder, sources = Path(folder), Path(root) / "report"
    titles = {"site": settings["title"], "footer": footer}
    write_site(folder, sources, pages, settings, titles, documented(settings["api"]["left_out"]))
    write_document(folder, sources, pages, settings, titles)


def write_site(folder: Path, sources: Path, pages, settings: dict, titles: dict, modules=()) -> None:
    """Write all pages by Sphinx, with a page for each module of the library.

    Raises:
        RuntimeError: Sphinx has a warning on a page of the report; docstrings may have some.
    """
    bodies = {page["name"]: body_of(page, sources, pages, settings) for page in settings["pages"]}
    footer = pypandoc.convert_text(f"{titles['footer']} [PDF]({PDF})", "html", FILLED)
    with TemporaryDirectory() as scratch:
        scratch = Path(scratch)
        for name in bodies:
            (scratch / f"{name}.rst").write_text(f".. page:: {name}\n\n", encoding="utf-8")
        library = api.write(scratch, modules)
        with (scratch / "index.rst").open("a", encoding="utf-8") as index:
            index.write(tables_of_contents(settings, library))
        (scratch / "static").mkdir()
        style = OF_MATHEMATICS + (sources / STYLE).read_text(encoding="utf-8")
        (scratch / "static" / STYLE).write_text(style, encoding="utf-8")
        told, extra = io.StringIO(), {"bodies": bodies, "project": settings["title"], "html_title": settings["title"]}
        with docutils_namespace():
            options = {"status": None, "warning": told, "parallel": 2}
            Sphinx(scratch, None, folder, scratch / "doctrees", "html", SPHINX | extra, **options).build()
    of_pages = [line for line in told.getvalue().splitlines() if OF_PAGE.search(line)]
    if of_pages:
        raise RuntimeError(f"Sphinx: {of_pages[0]}")

    for path in [*folder.glob("*.html"), *folder.glob("api/*.html")]:
        below = footer.replace(f'href="{PDF}"', f'href="{"../" * (path.parent != folder)}{PDF}"')
        text = path.read_text(encoding="utf-8")
        for theirs, better in UNNAMED.items():
            text = text.replace(theirs, better)
        text = THEME_FOOTER.sub(f'<div class="built">{below}</div></footer>'.replace("\\", r"\\"), text)
        path.write_text(finished(text, path.parent, sources), encoding="utf-8")
    shutil.rmtree(folder / "_sources", ignore_errors=True)


def finished(page: str, folder: Path, sources: Path) -> str:
    """Return a page with the scripts of generator and report inside, and a policy that allows no other."""
    theme, last = INLINE.findall(page), ""

    def inlined(found):
        nonlocal last
        path = folder / found[1]
        if not path.is_file():
            return found[0]  # of the report
        theme.append(path.read_text(encoding="utf-8").replace("</", r"<\/"))
        script = f"<script>{theme[-1]}</script>"
        if path.name != "searchindex.js":
            return script
        last = script  # it needs those before it
        return ""

    page = GENERATED.sub(inlined, page).replace("</body>", f"{last}</body>")
    return guarded(page, lambda name: (sources / name).read_text(encoding="utf-8"), theme)


def tables_of_contents(settings: dict, library: list[str]) -> str:
    """Return the pages in their groups, as tables of contents in reStructuredText."""
    groups = {}
    for page in settings["pages"]:
        groups.setdefault(page["group"], []).append(page)
    groups["library"] = [{"name": f"api/{name}", "title": name} for name in library]
    tables = (
        f".. toctree::\n   :hidden:\n   :titlesonly:\n   :caption: {group.capitalize()}\n\n"
        + "".join(f"   {page['title']} <{'self' if page['name'] == 'index' else page['name']}>\n" for page in listed)
        for group, listed in groups.items()
    )
    return "\n".join(tables)


def body_of(page: dict, sources: Path, pages, settings: dict) -> str:
    """Return the HTML of one page from its first heading on, with the scripts of all pages at its end."""
    known = {"page": page["name"], "titles": titles_of(settings), "equations": settings["equations"]}
    text = convert(pages.markdown(page, "html"), "html", sources, known, reader_of(page))
    return text + "".join(f'\n<script src="{name}"></script>' for name in settings.get("scripts", []))


class Page(Directive):
    """Sphinx directive for a page of the report: its sections serve search and navigation."""

    required_arguments = 1

    def run(self):
        html = self.state.document.settings.env.config.bodies[self.arguments[0]]
        before, *parts = HEADING.split(html)
        sections = [nodes.section()]
        for level, name, title, text in zip(*[iter(parts)] * 4, strict=True):
            section = nodes.section(ids=[name], names=[])
            section += [nodes.title("", "", raw(title)), raw(text)]
            sections[int(level) :] = []
            sections[-1] += section
            sections.append(section)
        return [raw(before), *sections[0].children] if before.strip() else sections[0].children


def raw(html: str) -> nodes.raw:
    return nodes.raw("", html, format="html")


def as_text(app, what, name, obj, options, lines: list[str]) -> None:
    """Escape bars in docstrings, which are absolute values and choices there."""
    lines[:] = [line.replace("|", r"\|") for line in lines]


def setup(app) -> dict:
    """Register the extension with Sphinx."""
    app.add_config_value("bodies", {}, "")
    app.add_directive("page", Page)
    app.connect("autodoc-process-docstring", as_text)
    return {"parallel_read_safe": True, "parallel_write_safe": True}


SPHINX = {
    "extensions": ["sphinx.ext.autodoc", "sphinx.ext.napoleon", __name__],
    "html_theme": "furo",
    "html_static_path": ["static"],
    "html_css_files": [STYLE],
    "html_show_search_summary": False,  # its text is fetched, which no browser does from a disk
    "html_show_sourcelink": False,
    "html_copy_source": False,
    "html_use_index": False,
    "html_domain_indices": False,
    "html_permalinks": False,
    "html_favicon": None,
    "default_role": "literal",
    "autodoc_member_order": "bysource",
    "autodoc_typehints": "signature",
    "python_use_unqualified_type_names": True,
    "language": "en",
}


def write_document(folder: Path, sources: Path, pages, settings: dict, titles: dict) -> None:
    """Write all pages of the paper as one PDF."""
    paper = {page["name"]: True for page in settings["pages"] if page.get("paper")}
    known = {"titles": titles_of(settings), "paper": paper}
    chapters = [
        convert(pages.markdown(page, "pdf"), "typst", sources, known | {"page": page["name"]}, reader_of(page))
        for page in settings["pages"]
        if page["name"] in paper
    ]
    document = (sources / "document.typ").read_text(encoding="utf-8")
    abstract = settings["done"] if pages.departures else f"{settings['done']} {settings['found']}"
    titles = titles | {"abstract": abstract}
    titles = {name: pypandoc.convert_text(text, "typst", FILLED).strip() for name, text in titles.items()}
    for name, text in {**titles, "body": "\n\n".join(chapters)}.items():
        document = document.replace(f"${name}$", text)
    typst.compile(document.encode(), output=folder / PDF, root=folder, ignore_system_fonts=True)


def titles_of(settings: dict) -> dict:
    """Return titles of pages by name, for links without words."""
    return {page["name"]: page["title"] for page in settings["pages"]}


def reader_of(page: dict) -> str:
    return FILLED if is_template(page) else READER


def convert(markdown: str, target: str, sources: Path, known: dict, reader: str = READER) -> str:
    """Return one page in HTML or Typst; `known` is its metadata, in Markdown.

    Raises:
        math_core.LatexError: a formula cannot be translated to MathML.
        RuntimeError: pandoc has a warning.
    """
    with TemporaryDirectory() as scratch:
        metadata = Path(scratch) / "metadata.json"
        metadata.write_text(json.dumps(known), encoding="utf-8")
        options = [f"--metadata-file={metadata}", f"--lua-filter={sources / 'filter.lua'}", "--columns=10000"]
        options += ["--mathjax", "--fail-if-warnings", "--wrap=none"]
        text = pypandoc.convert_text(markdown, target, reader, options)
    return kept(FORMULA.sub(as_mathml, text)) if target == "html" else text


def as_mathml(formula: re.Match) -> str:
    """Return a formula found by FORMULA as MathML."""
    kind, tex = formula.groups()
    return mathml(html.unescape(tex), display=kind == "display")
