"""Markdown pages -> a static site and one PDF of the same content, by pandoc and Typst. Nothing is fetched."""

import json
import shutil
from pathlib import Path
from tempfile import TemporaryDirectory

import pypandoc
import typst

READER = "markdown-fancy_lists-auto_identifiers+gfm_auto_identifiers"
"""Without lists that begin with "(3)": here that is an equation at the start of a paragraph."""
PDF = "report.pdf"
SHARED = ("style.css", "animation.js", "travel.js")


def write(folder, root, pages, settings: dict, footer: str) -> None:
    """Write the site and its PDF into a folder that has the figures already."""
    folder, sources = Path(folder), Path(root) / "report"
    for name in SHARED:
        shutil.copy(sources / name, folder / name)
    chapters = []
    for page in settings["pages"]:
        known = {"page": page["name"], "pagetitle": page["title"], "site": settings["title"], "footer": footer}
        nav = [{**other, "current": other is page} for other in settings["pages"]]
        html = convert(pages.markdown(page, "html"), "html", sources, {**known, "nav": nav, "pdf": PDF}, "page.html")
        (folder / f"{page['name']}.html").write_text(html, encoding="utf-8")
        chapters.append(convert(pages.markdown(page, "pdf"), "typst", sources, known))
    document = (sources / "document.typ").read_text(encoding="utf-8")
    for name, text in {"site": settings["title"], "footer": footer, "body": "\n\n".join(chapters)}.items():
        document = document.replace(f"${name}$", text)
    typst.compile(document.encode(), output=folder / PDF, root=folder, ignore_system_fonts=True)


def convert(markdown: str, target: str, sources: Path, known: dict, template: str | None = None) -> str:
    """One page in HTML or Typst; `known` is its metadata. A formula or link that pandoc cannot render is an error."""
    with TemporaryDirectory() as scratch:
        metadata = Path(scratch) / "metadata.json"
        metadata.write_text(json.dumps(known), encoding="utf-8")
        options = [f"--metadata-file={metadata}", f"--lua-filter={sources / 'filter.lua'}", "--columns=10000"]
        options += ["--mathml", "--fail-if-warnings", "--wrap=none"]
        if template:
            options += [f"--template={sources / template}", "--toc", "--toc-depth=3"]
        return pypandoc.convert_text(markdown, target, READER, options)
