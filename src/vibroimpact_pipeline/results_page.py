"""What to open first: the report, else results/index.html, a page that links what a build has made."""

import json
import re
from collections import Counter
from collections.abc import Iterable
from html import escape
from itertools import chain
from pathlib import Path
from urllib.parse import quote

from vibroimpact.figures.kit.files import replacing

RESULTS = Path("results")
INDEX, REPORT = RESULTS / "index.html", RESULTS / "report/index.html"
OWN = {
    **dict.fromkeys(("figure_check", "figure_check_strict", "compare_figures"), "figure_check/index.html"),
    "report": "report/index.html",
}
"""Pages of targets; a figure has its own in results/notebooks/, a sweep in results/sweeps/."""
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


def first_page(targets: Iterable[str]) -> str | None:
    """Path of the page to open after a build: that of a target, else the report, else the index; None without one.

    A report that is older than a result beside it is passed over.
    """
    own = chain.from_iterable(
        (RESULTS / OWN.get(name, f"notebooks/{name}.html"), RESULTS / f"sweeps/{name.removeprefix('sweep_')}.html")
        for name in targets
    )
    others = [REPORT] * _is_current(REPORT) + [INDEX]
    return next((str(page) for page in (*own, *others) if page.is_file()), None)


def _is_current(report):
    made = chain.from_iterable(RESULTS.glob(pattern) for pattern in ("*.json", "*.csv", "figures/*", "notebooks/*"))
    return report.is_file() and report.stat().st_mtime >= max((path.stat().st_mtime for path in made), default=0)


def write(titles: dict[str, str]) -> None:
    """Write the index of what lies in results/.

    Args:
        titles: of the figures, by name, in the order in which they are listed.
    """
    from vibroimpact_pipeline.report.mathematics import STYLE  # loads a font and a converter, which few builds need
    from vibroimpact_pipeline.report.policy import guarded

    parts = [_overview(), *_figures(titles), _list("Tables", map(_file, _tables()))]
    with replacing(INDEX) as partial:
        partial.write_text(guarded(PAGE.format(style=STYLE, body="\n".join(parts))), encoding="utf-8")


def _overview():
    """How many claims got which verdict, and where they are."""
    said = ["<p>Every figure leads to its page, which says how it is made and what the exact system says of it.</p>"]
    if (claims := RESULTS / "claims.json").is_file():
        counts = Counter(claim["verdict"] for claim in json.loads(claims.read_text(encoding="utf-8")))
        ordered = sorted(counts.most_common(), key=lambda one: one[0] == "misprint")  # these come last
        verdicts = ", ".join(f"{escape(verdict)} {number}" for verdict, number in ordered)
        page = _link(RESULTS / "claims.md", f"{counts.total()} claims of the chapter")
        said.append(f"<p>The {page}, each judged by computed numbers: {verdicts}.</p>")
    return "\n".join(said)


def _figures(titles):
    """A list of the figures with pages, and one of the others."""
    entries = {True: [], False: []}
    for name, title in titles.items():
        page = RESULTS / f"notebooks/{name}.html"
        drawn = [RESULTS / folder / f"{name}{kind}" for folder in ("figures", "accuracy") for kind in KINDS]
        links = [_link(path, KINDS[path.suffix]) for path in (page, *drawn) if path.is_file()]
        if links:
            entries[page.is_file()].append(f"{escape(title)}: {' · '.join(links)}{_exact(page)}")
    return _list("Figures with a page", entries[True]), _list("Further figures", entries[False])


def _exact(page):
    """What the page of a figure says of the exact system."""
    found = EXACT.search(page.read_text(encoding="utf-8")) if page.is_file() else None
    return f"<br>{found[1]}" if found else ""


def _tables():
    return sorted(chain.from_iterable(RESULTS.glob(pattern) for pattern in TABLES))


def _file(path):
    return _link(path, path.relative_to(RESULTS))


def _link(path, text):
    return f'<a href="{quote(str(path.relative_to(RESULTS)))}">{escape(str(text))}</a>'


def _list(heading, entries):
    items = "\n".join(f"<li>{entry}</li>" for entry in entries)
    return f"<h2>{heading}</h2>\n<ul>\n{items}\n</ul>" if items else ""
