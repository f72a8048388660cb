"""The first page after a build: the exact system's verdict on each figure, and links to all results."""

import json
import re
from collections import Counter
from pathlib import Path

from jinja2 import Environment

from vibroimpact_pipeline.html.mathematics import STYLE
from vibroimpact_pipeline.html.policy import guarded

TEMPLATE = Path(__file__).with_name("results_page.html.j2")
EXACT = re.compile(r"<p>(<strong>The exact system:</strong>.*?)</p>", re.DOTALL)
KINDS = {"PNG": ".png", "SVG": ".svg", "PDF": ".pdf", "numbers (CSV)": ".csv"}
TABLES = "*.csv", "*.json", "*.md", "regimes/*.csv", "accuracy/*.csv", "sweeps/*.csv"


def page(results: Path, groups: dict[str, dict[str, str]]) -> str:
    """Return the index of the results of a build as offline HTML.

    Args:
        results: the directory.
        groups: titles of the figures by name, by heading, in the order in which they are listed.
    """
    listed = {heading: _listed(results, titles) for heading, titles in groups.items()}
    claims = results / "claims.json"
    verdicts = [claim["verdict"] for claim in json.loads(claims.read_text("utf-8"))] if claims.is_file() else []
    counts = sorted(Counter(verdicts).most_common(), key=lambda one: one[0] == "misprint")  # these come last
    tables = sorted(str(path.relative_to(results)) for pattern in TABLES for path in results.glob(pattern))
    environment = Environment(autoescape=True, trim_blocks=True, lstrip_blocks=True)
    template = environment.from_string(TEMPLATE.read_text(encoding="utf-8"))
    return guarded(template.render(style=STYLE, counts=counts, tables=tables, groups=listed))


def _listed(results, titles) -> list[dict]:
    """Return the figures that are there: title, links, the sentence on the exact system, and the picture."""
    found = []
    for name, title in titles.items():
        drawn = [(kind, f"{place}/{name}{end}") for place in ("figures", "accuracy") for kind, end in KINDS.items()]
        written = f"notebooks/{name}.html"
        links = [(kind, path) for kind, path in [("page", written), *drawn] if (results / path).is_file()]
        explained = ("page", written) in links
        exact = EXACT.search((results / written).read_text(encoding="utf-8")) if explained else None
        if links:
            picture = next((path for kind, path in links if kind == "SVG"), None)
            figure = {"title": title, "links": links, "exact": exact and exact[1], "picture": picture}
            found.append(figure)
    return found
