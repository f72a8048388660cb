"""Markdown pages -> a static site and one PDF of the same content, by pandoc and Typst. Nothing is fetched."""

import html
import json
import re
from pathlib import Path
from tempfile import TemporaryDirectory

import pypandoc
import typst

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
PDF = "report.pdf"
STYLE = "style.css"


def write(folder, root, pages, settings: dict, footer: str) -> None:
    """Write the site and its PDF into a folder that has the figures already; the footer is Markdown."""
    folder, sources = Path(folder), Path(root) / "report"
    (folder / STYLE).write_text(OF_MATHEMATICS + (sources / STYLE).read_text(encoding="utf-8"), encoding="utf-8")
    titles = {"site": settings["title"], "footer": footer}
    for page in settings["pages"]:
        text = site_page(page, sources, pages, settings, titles)
        (folder / f"{page['name']}.html").write_text(text, encoding="utf-8")
    write_document(folder, sources, pages, settings, titles)


def site_page(page: dict, sources: Path, pages, settings: dict, titles: dict) -> str:
    """One page of the site."""
    known = {"page": page["name"], "pagetitle": page["title"], "nav": navigation(page, settings)}
    known |= titles | {"titles": titles_of(settings)}
    text = convert(pages.markdown(page, "html"), "html", sources, known, "page.html", reader_of(page))
    return guarded(text, lambda name: (sources / name).read_text(encoding="utf-8"))


def navigation(page: dict, settings: dict) -> list[dict]:
    """The pages in their groups, and what belongs to the last of these without being a page."""
    groups = {}
    for other in settings["pages"]:
        entry = {"address": f"{other['name']}.html", "title": other["title"], "current": other is page}
        groups.setdefault(other["group"], []).append(entry)
    groups["rerun"] += [{"address": "api/vibroimpact.html", "title": "The library"}, {"address": PDF, "title": "PDF"}]
    return [
        {"group": group.capitalize(), "current": group == page["group"], "pages": pages}
        for group, pages in groups.items()
    ]


def write_document(folder: Path, sources: Path, pages, settings: dict, titles: dict) -> None:
    """All pages as one PDF."""
    known = {"titles": titles_of(settings)}
    chapters = [
        convert(pages.markdown(page, "pdf"), "typst", sources, known | {"page": page["name"]}, reader=reader_of(page))
        for page in settings["pages"]
    ]
    document = (sources / "document.typ").read_text(encoding="utf-8")
    abstract = settings["done"] if pages.departures else f"{settings['done']} {settings['found']}"
    titles = titles | {"abstract": abstract}
    titles = {name: pypandoc.convert_text(text, "typst", FILLED).strip() for name, text in titles.items()}
    for name, text in {**titles, "body": "\n\n".join(chapters)}.items():
        document = document.replace(f"${name}$", text)
    typst.compile(document.encode(), output=folder / PDF, root=folder, ignore_system_fonts=True)


def titles_of(settings: dict) -> dict:
    """What links to pages are called that have no words but the name of a file."""
    return {page["name"]: page["title"] for page in settings["pages"]}


def reader_of(page: dict) -> str:
    return FILLED if is_template(page) else READER


def convert(
    markdown: str, target: str, sources: Path, known: dict, template: str | None = None, reader: str = READER
) -> str:
    """One page in HTML or Typst; `known` is its metadata, in Markdown.

    Raises:
        math_core.LatexError: a formula cannot be translated to MathML.
        RuntimeError: pandoc has a warning.
    """
    with TemporaryDirectory() as scratch:
        metadata = Path(scratch) / "metadata.json"
        metadata.write_text(json.dumps(known), encoding="utf-8")
        options = [f"--metadata-file={metadata}", f"--lua-filter={sources / 'filter.lua'}", "--columns=10000"]
        options += ["--mathjax", "--fail-if-warnings", "--wrap=none"]
        if template:
            options += [f"--template={sources / template}", "--toc", "--toc-depth=3"]
        text = pypandoc.convert_text(markdown, target, reader, options)
    return kept(FORMULA.sub(as_mathml, text)) if target == "html" else text


def as_mathml(formula: re.Match) -> str:
    """A formula as the notebooks' pages have it, which browsers draw by themselves."""
    kind, tex = formula.groups()
    return mathml(html.unescape(tex), display=kind == "display")
