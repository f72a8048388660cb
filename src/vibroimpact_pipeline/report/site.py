"""Markdown pages -> a static site and one PDF of the same content, by pandoc and Typst. Nothing is fetched."""

import html
import json
import re
import shutil
from pathlib import Path
from tempfile import TemporaryDirectory

import pypandoc
import typst

from vibroimpact_pipeline.environment import SCRATCH
from vibroimpact_pipeline.report.offline import MATHEMATICS

READER = "markdown-fancy_lists+gfm_auto_identifiers"
"""Headings can be linked to; no list begins with "(3)": here that is an equation at the start of a paragraph."""
FORMULA = re.compile(r'<span\s+class="math (inline|display)">\\[(\[](.*?)\\[)\]]</span>', re.DOTALL)
"""A formula as pandoc leaves it for others to set."""
PDF = "report.pdf"
SHARED = ("style.css", "animation.js", "force_sweep.js")


def write(folder, root, pages, settings: dict, footer: str) -> None:
    """Write the site and its PDF into a folder that has the figures already."""
    folder, sources = Path(folder), Path(root) / "report"
    for name in SHARED:
        shutil.copy(sources / name, folder / name)
    chapters = []
    for page in settings["pages"]:
        known = {"page": page["name"], "pagetitle": page["title"], "site": settings["title"], "footer": footer}
        nav = [{**other, "current": other is page} for other in settings["pages"]]
        text = convert(pages.markdown(page, "html"), "html", sources, {**known, "nav": nav, "pdf": PDF}, "page.html")
        (folder / f"{page['name']}.html").write_text(text, encoding="utf-8")
        chapters.append(convert(pages.markdown(page, "pdf"), "typst", sources, known))
    document = (sources / "document.typ").read_text(encoding="utf-8")
    for name, text in {"site": settings["title"], "footer": footer, "body": "\n\n".join(chapters)}.items():
        document = document.replace(f"${name}$", text)
    typst.compile(document.encode(), output=folder / PDF, root=folder, ignore_system_fonts=True)


def convert(markdown: str, target: str, sources: Path, known: dict, template: str | None = None) -> str:
    """One page in HTML or Typst; `known` is its metadata.

    Raises:
        math_core.LatexError: a formula cannot be translated to MathML.
        RuntimeError: pandoc has a warning.
    """
    with TemporaryDirectory(prefix=SCRATCH) as scratch:
        metadata = Path(scratch) / "metadata.json"
        metadata.write_text(json.dumps(known), encoding="utf-8")
        options = [f"--metadata-file={metadata}", f"--lua-filter={sources / 'filter.lua'}", "--columns=10000"]
        options += ["--mathjax", "--fail-if-warnings", "--wrap=none"]
        if template:
            options += [f"--template={sources / template}", "--toc", "--toc-depth=3"]
        text = pypandoc.convert_text(markdown, target, READER, options)
    return FORMULA.sub(as_mathml, text) if target == "html" else text


def as_mathml(formula: re.Match) -> str:
    """A formula as the notebooks' pages have it, which browsers draw by themselves."""
    kind, tex = formula.groups()
    return MATHEMATICS.convert_with_local_state(html.unescape(tex), displaystyle=kind == "display")
