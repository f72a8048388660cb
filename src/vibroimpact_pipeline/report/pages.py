"""Pages of the report as Markdown: templates and documents, filled from results."""

import json
import math
import re
from collections import Counter
from functools import lru_cache
from html import escape
from itertools import count
from pathlib import Path
from urllib.parse import quote

import jinja2
import pypandoc

from vibroimpact.claims.finding import VERDICTS
from vibroimpact.claims.judge import facts
from vibroimpact.figures.kit.markdown import code, one_line, plain
from vibroimpact_pipeline import data_dictionary
from vibroimpact_pipeline.report.figure_texts import figure_texts
from vibroimpact_pipeline.report.live import live_data, verdict_data
from vibroimpact_pipeline.report.notation import named

HEADING = re.compile(r"^# .*$", re.MULTILINE)
PICTURE = re.compile(r"^!\[.*?\]\(\.\./results/\w+/(?P<name>\w+)\.png\)$", re.MULTILINE)
"""A picture of a document; left out where the config does not make the figure."""
SOURCED = re.compile(r"(?P<number>−?[\d.]+)<!-- (?P<percent>percent \| )?(?P<place>.+?) -->(?P<mark>[.,;:)]*)")
"""A number of a document, in a comment behind it the file that it comes from and the place there, and what ends it."""
SOURCE = (
    '`<span class="kept"><button type="button" class="sourced" title="{value} in results/{file}: {place}" '
    'popovertarget="source-{id}">{number}</button>'
    '<span popover class="source" id="source-{id}"><b>{value}</b> in <code>results/{file}</code>: {place}. '
    "Made by <code>snakemake --cores 2 results/{file}</code></span>{mark}</span>`{{=html}}"
)
NOTICE = (
    "**This build has other parameters than the chapter.** Its figures and tables are its own; claims were not judged, "
    "and what documents, findings and errata say is about the chapter's parameters. What differs:"
)


class Pages:
    """Pages of the report, filled from results.

    Args:
        root: the checkout.
        results: a `report_results.Results`.
        settings: report/report.yaml.
        config: the config of the pipeline.
        shown: names of figures by group, in the order in which they are shown.
        tables: paths of further results to download.
        departures: where the config departs from the chapter's parameters, a line each; every page then says so.
    """

    def __init__(self, root, results, settings: dict, config: dict, shown: dict, tables=(), departures=()):
        self.root, self.results, self.settings, self.config = Path(root), results, settings, config
        self.departures = departures
        self.pictures = {figure for group in shown.values() for figure in group}
        self.about = figure_texts(self.root, config)
        self.environment = jinja2.Environment(
            loader=jinja2.FileSystemLoader(self.root),
            undefined=jinja2.StrictUndefined,
            comment_start_string="{##",  # since {# begins the name of a heading
            comment_end_string="##}",
            trim_blocks=True,
            lstrip_blocks=True,
            keep_trailing_newline=True,
        )
        self.environment.filters |= FILTERS
        self.environment.globals |= {
            "results": results,
            "config": config,
            "settings": settings,
            "shown": shown,
            "tables": [Path(path) for path in tables],
            "about": self.about,
            "dictionary": lambda: data_dictionary.page(*data_dictionary.read(self.root)),
            "caption": lru_cache(self.caption),
            "count": Counter,
            "infinity": math.inf,
            "live_data": live_data,
            "verdict_data": verdict_data,
            "table": markdown_table,
            "verdicts": verdicts,
            "facts": facts,
        }

    def markdown(self, page: dict, target: str) -> str:
        """Return one page for a target, "html" or "pdf". Documents stay as they are, templates are filled."""
        if is_template(page):
            text = self.environment.get_template(page["source"]).render(target=target)
        else:
            text = (self.root / page["source"]).read_text(encoding="utf-8")
            text = PICTURE.sub(lambda picture: picture[0] if picture["name"] in self.pictures else "", text)
            if target == "html" and self.results.judged:
                numbers = count(1)
                text = SOURCED.sub(lambda found: self._with_source(found, next(numbers)), text)
        return HEADING.sub(lambda heading: heading[0] + self._notice(), text, count=1) if self.departures else text

    def _with_source(self, found, number):
        """Return a number of a document as a button that shows its value, its place, and the command that makes it.

        The number is that of the build, to as many decimals as the document gives. In a build with other settings there
        may be no such value: then the number stays as it is.
        """
        file, *place = found["place"].split(" | ")
        try:
            value = self.results.value(file, *place)
            decimals = len(found["number"].partition(".")[2])
            inserted = f"{value * (100 if found['percent'] else 1):.{decimals}f}".replace("-", "−")
        except (LookupError, TypeError, ValueError, StopIteration, OSError):
            return found["number"] + found["mark"]
        told = {"number": inserted, "mark": found["mark"], "value": f"{value:.6g}"}
        told |= {"file": file, "place": ", ".join(place), "id": number}
        return SOURCE.format(**{name: escape(str(text)) for name, text in told.items()})

    def _notice(self):
        """Return the notice that begins every page if the config departs from the chapter."""
        return f"\n\n::: notice\n{NOTICE} {'; '.join(map(plain, self.departures))}.\n:::\n"

    def caption(self, figure: str) -> str:
        """Return the caption of a figure, written in reStructuredText, as Markdown in one line."""
        text = self.about[figure]["caption"]
        return pypandoc.convert_text(text, "markdown", "rst", ["--wrap=none"]).strip().replace("\n", " ")


def is_template(page: dict) -> bool:
    """Return True for a page filled from results, False for a document."""
    return not page["source"].startswith("docs/")


def digits(value, number: int = 3) -> str:
    """Return a number with so many significant digits; tiny and huge ones as a power of ten in a formula."""
    if value is None or value != value:
        return "–"
    rounded = float(f"{value:.{number}g}")
    if rounded == 0 or 1e-4 <= abs(rounded) < 1e6:
        return f"{rounded:.15g}"
    mantissa, exponent = f"{rounded:.{number - 1}e}".split("e")
    factor = "" if float(mantissa) == 1 else rf"{float(mantissa):.15g}\cdot "
    return rf"${factor}10^{{{int(exponent)}}}$"


def setting(value) -> str:
    """Return a setting of a method, a number or a word."""
    try:
        return digits(float(value))
    except ValueError:
        return plain(value)


def cell(text) -> str:
    """Return Markdown of the repository for a cell of a table."""
    return re.sub(r"\s+", " ", str(text)).replace("|", r"\|").strip()


def said(numbers) -> str:
    """Return numbers and answers behind a claim in one line."""
    if numbers is None or isinstance(numbers, bool):
        return {True: "yes", False: "no", None: "open"}[numbers]
    if isinstance(numbers, dict):
        return "; ".join(f"{named(name)}: {said(value)}" for name, value in numbers.items())
    if isinstance(numbers, list):
        return ", ".join(said(value) for value in numbers)
    if not isinstance(numbers, int | float):
        return plain(numbers)
    return digits(numbers, 4)


def section_of(place: str) -> str:
    """Return the section of the chapter that a claim's place names, or that of its equation or figure."""
    if found := re.search(r"section (10\.\d)", place):
        return found[1]
    found = re.search(r"(?P<figure>Fig\w*\. )?\(?10\.(?P<number>\d+)", place)
    if not found:
        return "elsewhere"
    first_of = {"10.4": 6, "10.3": 4} if found["figure"] else {"10.3": 7}
    return next((section for section, first in first_of.items() if int(found["number"]) >= first), "10.2")


def markdown_table(heads: list[str], rows) -> str:
    """Return a pipe table of plain texts."""
    lines = [map(plain, heads), ["---"] * len(heads), *(map(plain, row) for row in rows)]
    return "\n".join("| " + " | ".join(line) + " |" for line in lines)


def verdicts(claims: list[dict]) -> list[tuple[str, int]]:
    """Return each verdict given with its number of claims, in the order of presentation."""
    given = Counter(claim["verdict"] for claim in claims)
    return [(verdict, given[verdict]) for verdict in VERDICTS if verdict in given]


def anchor(name) -> str:
    """Return the name of a place on a page."""
    return re.sub(r"[^\w-]", "-", str(name))


def attribute(text) -> str:
    """Return a text for HTML, between quotation marks or tags."""
    return escape(one_line(text))


def data(text: str) -> str:
    """Return JSON that can stand in a page: nothing in it ends the element.

    Raises:
        ValueError: it is no JSON.
    """
    return json.dumps(json.loads(text), separators=(",", ":")).replace("<", r"\u003c")


FILTERS = {
    "anchor": anchor,
    "attribute": attribute,
    "cell": cell,
    "code": code,
    "data": data,
    "digits": digits,
    "named": named,
    "plain": plain,
    "said": said,
    "section": section_of,
    "setting": setting,
    "url": quote,
}
"""Filters for values in a page; every value that is not a number goes through one."""
