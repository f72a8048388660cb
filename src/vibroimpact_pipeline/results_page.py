"""Make the index page of a build, with the figures, recommended methods and links.

The index page quotes what the notebook pages of the figures say about the exact system.
"""

import csv
import json
import math
import re
from collections import Counter
from itertools import groupby
from pathlib import Path

from vibroimpact_pipeline.html.mathematics import STYLE
from vibroimpact_pipeline.html.policy import rendered

TEMPLATE = Path(__file__).with_name("results_page.html.j2")
EXACT = re.compile(r"<p>(<strong>The exact system:</strong>.*?)</p>", re.DOTALL)
WIDE_HEADING = "Speed and accuracy"
"""Heading of the group of figures that the page shows at full text width."""
KINDS = {"PNG": ".png", "SVG": ".svg", "PDF": ".pdf", "numbers (CSV)": ".csv"}
TABLES = "*.csv", "*.json", "*.md", "regimes/*.csv", "accuracy/*.csv", "sweeps/*.csv"


def page(results: Path, groups: dict[str, dict[str, str]]) -> str:
    """Return the index of the results of a build as offline HTML.

    `groups` contains a mapping for each heading. The mapping contains the title of each figure, keyed by figure name.
    """
    listed = {heading: _listed(results, titles) for heading, titles in groups.items()}
    claims = results / "claims.json"
    verdicts = [claim["verdict"] for claim in json.loads(claims.read_text("utf-8"))] if claims.is_file() else []
    counts = sorted(Counter(verdicts).most_common(), key=lambda one: one[0] == "misprint")  # misprints come last
    tables = sorted(str(path.relative_to(results)) for pattern in TABLES for path in results.glob(pattern))
    shown = {"groups": listed, "counts": counts, "tables": tables, "chosen": _choices(results)}
    return rendered(TEMPLATE, style=STYLE, large=WIDE_HEADING, **shown)


def _choices(results) -> list[list[str]]:
    """Return one row for each problem and allowed error in accuracy/choices.csv.

    A row contains the problem, the decimal exponent of the allowed error, and one text for each recommended method.
    """
    path = results / "accuracy/choices.csv"
    rows = list(csv.DictReader(path.read_text(encoding="utf-8").splitlines())) if path.is_file() else []
    found = []
    for (problem, error), choices in groupby(rows, key=lambda row: (row["problem"], row["error"])):
        exponent = str(round(math.log10(float(error)))).replace("-", "−")
        methods = [
            f"{row['method']}, {1e6 * float(row['seconds_per_cycle']):.2g} µs; "
            f"silently wrong in {row['wrong']} of {row['tests']} stress tests"
            for row in choices
        ]
        found.append([problem, exponent, *methods])
    return found


def _listed(results, titles) -> list[dict]:
    """Return an entry for each figure that has files: its title, links, picture and comment on the exact system.

    The comment is the paragraph "The exact system: ..." of the notebook page of the figure.
    """
    found = []
    for name, title in titles.items():
        drawn = [(kind, f"{place}/{name}{end}") for place in ("figures", "accuracy") for kind, end in KINDS.items()]
        written = f"notebooks/{name}.html"
        links = [(kind, path) for kind, path in [("page", written), *drawn] if (results / path).is_file()]
        explained = ("page", written) in links
        exact = EXACT.search((results / written).read_text(encoding="utf-8")) if explained else None
        if links:
            picture = next((path for kind, path in links if kind == "SVG"), None)
            found.append({"title": title, "links": links, "exact": exact and exact[1], "picture": picture})
    return found
