"""The page to open first after a build: what the exact system says of each figure, and links to all results."""

import json
import re
from collections import Counter
from html import escape
from itertools import chain
from pathlib import Path
from urllib.parse import quote

from vibroimpact_pipeline.report.mathematics import STYLE
from vibroimpact_pipeline.report.policy import guarded

EXACT = re.compile(r"<p>(<strong>The exact system:</strong>.*?)</p>", re.DOTALL)
KINDS = {".html": "page", ".png": "PNG", ".svg": "SVG", ".pdf": "PDF", ".csv": "numbers (CSV)"}
TABLES = "*.csv", "*.json", "*.md", "regimes/*.csv", "accuracy/*.csv", "sweeps/*.csv"
PAGE = """\
<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>Results</title>
<style>
{style}
body {{ max-width: 50rem; margin: 2rem auto; padding: 0 1rem; color: #111; font: 1.05rem/1.55 Georgia, serif; }}
li {{ margin: 0.4rem 0; }}
</style>
</head>
<body>
<h1>Results</h1>
{body}
</body>
</html>
"""


def page(results: Path, titles: dict[str, str]) -> str:
    """The index of the results of a build as HTML that reads offline.

    Args:
        results: the directory.
        titles: of the figures, by name, in the order in which they are listed.
    """
    files = sorted(chain.from_iterable(results.glob(pattern) for pattern in TABLES))
    tables = [_link(*2 * [path.relative_to(results)]) for path in files]
    parts = [_overview(results), *_figures(results, titles), _list("Tables", tables)]
    return guarded(PAGE.format(style=STYLE, body="\n".join(parts)))


def _overview(results):
    """How many claims got which verdict, and where they are."""
    said = ["<p>Every figure leads to its page, which says how it is made and what the exact system says of it.</p>"]
    if (claims := results / "claims.json").is_file():
        counts = Counter(claim["verdict"] for claim in json.loads(claims.read_text(encoding="utf-8")))
        ordered = sorted(counts.most_common(), key=lambda one: one[0] == "misprint")  # these come last
        verdicts = ", ".join(f"{escape(verdict)} {number}" for verdict, number in ordered)
        page = _link("claims.md", f"{counts.total()} claims of the chapter")
        said.append(f"<p>The {page}, each judged by computed numbers: {verdicts}.</p>")
    return "\n".join(said)


def _figures(results, titles):
    """A list of the figures with pages, and one of the others."""
    entries = {True: [], False: []}
    for name, title in titles.items():
        page = results / f"notebooks/{name}.html"
        drawn = [results / folder / f"{name}{kind}" for folder in ("figures", "accuracy") for kind in KINDS]
        links = [_link(path.relative_to(results), KINDS[path.suffix]) for path in (page, *drawn) if path.is_file()]
        if links:
            entries[page.is_file()].append(f"{escape(title)}: {' · '.join(links)}{_exact(page)}")
    return _list("Figures with a page", entries[True]), _list("Further figures", entries[False])


def _exact(page):
    """What the page of a figure says of the exact system."""
    found = EXACT.search(page.read_text(encoding="utf-8")) if page.is_file() else None
    return f"<br>{found[1]}" if found else ""


def _link(address, text):
    return f'<a href="{quote(str(address))}">{escape(str(text))}</a>'


def _list(heading, entries):
    items = "\n".join(f"<li>{entry}</li>" for entry in entries)
    return f"<h2>{heading}</h2>\n<ul>\n{items}\n</ul>" if items else ""
