"""Pages of the report as Markdown: documents with the numbers of this build, templates filled from results."""

import json
import re
from html import escape
from pathlib import Path
from urllib.parse import quote

import jinja2
import yaml

from vibroimpact.figures.plotting.markdown import code, one_line, plain
from vibroimpact_pipeline import data_dictionary
from vibroimpact_pipeline.html.figure_texts import figure_texts
from vibroimpact_pipeline.studies.report.live import live_data, verdict_data, verdict_dots

TEMPLATES = "report/pages"
NUMBER = re.compile(r"\[(?P<number>−?[\d.]+)\]\((?:studies/)?numbers\.yaml#(?P<key>[\w.-]+)\)")
"""A number of a document, with the key to its place among the results."""
PICTURE = re.compile(r"(?P<text>!?\[[^\]]*\])\((?:\.\./)+results/\w+/(?P<name>\w+)\.png\)")
"""A figure that a document shows, with its caption, or links to."""
LIVE = re.compile(r"<!-- live: (?P<part>\w+) -->\n(?P<still>.*?)(?=\n\n)", re.DOTALL)
"""What stands in a document for a part of report/parts, on paper and where a build has no data for it."""
SHOWN = """\
```{{figure}} figures/{name}.svg
:alt: {alt}
:target: figures/{name}.svg

{caption}
```"""
FIGURE = """\
.. figure:: figures/{name}.svg
   :alt: {alt}
   :target: figures/{name}.svg

   {caption}"""
"""In reStructuredText, in which captions are, for Snakemake's own report, too."""


class Pages:
    """Pages of the report.

    Args:
        root: the checkout.
        results: a `Results`.
        config: the config of the pipeline.
        shown: names of figures by group, in the order in which they are shown.
        tables: names of further results to download.
    """

    def __init__(self, root, results, config: dict, shown: dict, tables=()):
        self.root, self.results = Path(root), results
        self.names = sorted(path.stem for path in (self.root / TEMPLATES).glob("*.md"))
        self.chapter = shown.get("chapter", [])
        self.pictures = {figure for group in shown.values() for figure in group}
        self.about = figure_texts(self.root, config)
        self.places = yaml.safe_load((self.root / "docs/studies/numbers.yaml").read_text(encoding="utf-8"))
        self.environment = jinja2.Environment(
            loader=jinja2.FileSystemLoader(self.root / "report"),
            undefined=jinja2.StrictUndefined,
            trim_blocks=True,
            lstrip_blocks=True,
        )
        self.environment.filters |= FILTERS
        self.environment.globals |= {
            "results": results,
            "config": config,
            "shown": shown,
            "tables": tables,
            "about": self.about,
            "figure": self.figure,
            "table": table,
            "data": data,
            "dictionary": lambda of_figures: data_dictionary.page(*data_dictionary.read(self.root), of_figures),
            "live_data": lambda: live_data(results, config),
            "verdict_data": lambda: verdict_data(results, config),
            "verdict_dots": lambda: verdict_dots(results),
        }

    def filled(self, name: str) -> str:
        """Return a page of report/pages."""
        return self.environment.get_template(f"pages/{name}.md").render()

    def with_numbers(self, text: str, paper: bool = False) -> str:
        """Return a document with the numbers and figures of this build.

        A number has as many decimals as the document gives, and but on paper says where it is from. In a build with
        other settings there may be no such value: then it stays as it is written.
        """
        if not paper:
            text = LIVE.sub(lambda found: self._live(**found.groupdict()), text)
        text = NUMBER.sub(lambda found: self._number(paper, **found.groupdict()), text)
        return PICTURE.sub(lambda found: self._picture(paper, **found.groupdict()), text)

    def _number(self, paper, number, key):
        place = self.places[key]
        try:
            value = self.results.value(place)
            shown = f"{value:.{len(number.partition('.')[2])}f}".replace("-", "−")
        except (LookupError, TypeError, ValueError, StopIteration, OSError):
            return number
        source = place.removeprefix("percent | ").replace(" | ", ", ")  # a bar would end the cell of a table
        return shown if paper else f"{{abbr}}`{shown} ({value:.6g}: results/{source})`"

    def _picture(self, paper, text, name):
        if text.startswith("!"):
            if name not in self.pictures:
                return ""
            if paper:
                return f"{text}(figures/{name}.svg)"
            return SHOWN.format(name=quote(name), alt=one_line(self.about[name]["alt"]), caption=text[2:-1])
        return text[1:-1] if paper or name not in self.pictures else f"{text}(#{name})"

    def plates(self) -> str:
        """Return the pictures of the chapter for the end of the article on paper, those left out that it shows."""
        shown = (name for name in self.chapter if name != "fig10_01")
        plates = [f"![{plain(self.about[name]['title'])}](../results/figures/{name}.png)" for name in shown]
        return "\n\n".join(["\n## The figures of the chapter", *plates]) if plates else ""

    def _live(self, part, still):
        try:
            return f"```{{raw}} html\n{self.environment.get_template(f'parts/{part}.html').render()}\n```"
        except OSError:
            return still

    def figure(self, name: str, level: int = 2) -> str:
        """Return the section of a figure: equations, picture, files, origin."""
        about, record = self.about[name], self.results.provenance(name)
        files = self.results.files(name)
        links = [
            f"[{kind.upper() if path.suffix == f'.{kind}' else plain(kind)}](beside:figures/{quote(path.name)})"
            for kind, path in files.items()
        ]
        if self.results.notebook(name):
            links.append(f"[the notebook that draws it](beside:notebooks/{quote(name)}.html)")
        if "csv" in files:
            page = "data_figures" if files["csv"].parent.name == "figures" else "data"
            links.append(f"[what the columns mean]({page}.md)")
        origin = [plain(about["method"])] if "method" in about else []
        origin += (
            [f"commit {code(record['commit'][:12])} ({plain(record['tree'])} tree)"] if record.get("commit") else []
        )
        origin += [f"config {', '.join(map(code, record['config']))}"] if record.get("config") else []
        origin += [f"{plain(part)} {plain(number)}" for part, number in record.get("versions", {}).items()]
        return "\n\n".join(
            [
                f"({anchor(name)})=\n{'#' * level} {plain(about['title'])}",
                *(f"$$\n{formula.strip()}\n$$" for formula in about.get("equations", [])),
                self.picture(name, files),
                f"**Files:** {' · '.join(links)}",
                f"**Where it comes from:** {'; '.join(origin)}" if record else "",
            ]
        )

    def picture(self, name: str, files) -> str:
        """Return the caption of a figure with its picture, if it has one."""
        caption = " ".join(self.about[name]["caption"].split())
        if "svg" in files:
            caption = FIGURE.format(name=quote(name), alt=one_line(self.about[name]["alt"]), caption=caption)
        return f"``````````{{eval-rst}}\n{caption}\n``````````"


WORDS = {"None": "–", "nan": "–", "inf": "∞", "True": "yes", "False": "no"}
"""What is said in place of a value that is no number."""


def digits(value, number: int = 3) -> str:
    """Return a number with so many significant digits, tiny and huge ones with a power of ten; other values as text."""
    if isinstance(value, str):
        return plain(value)
    if str(value) in WORDS:
        return WORDS[str(value)]
    rounded = float(f"{value:.{number}g}")
    if rounded == 0 or 1e-4 <= abs(rounded) < 1e6:
        return f"{rounded:.15g}"
    mantissa, exponent = f"{rounded:.{number - 1}e}".split("e")
    factor = "" if float(mantissa) == 1 else rf"{float(mantissa):.15g}\cdot "
    return rf"${factor}10^{{{int(exponent)}}}$"


def table(frame, heads: dict, number: int = 3) -> str:
    """Return columns of a DataFrame as a pipe table, with a head in Markdown for each."""
    rows = [[digits(value, number) for value in row] for row in frame[list(heads)].itertuples(index=False)]
    return "\n".join("| " + " | ".join(line) + " |" for line in [heads.values(), ["---"] * len(heads), *rows])


def cell(text) -> str:
    """Return Markdown of the repository for a cell of a table."""
    return re.sub(r"\s+", " ", str(text)).replace("|", r"\|").strip()


def anchor(name) -> str:
    """Return the name of a place on a page."""
    return re.sub(r"[^\w-]", "-", str(name))


def attribute(text) -> str:
    """Return a text for HTML, between quotation marks or tags."""
    return escape(one_line(text))


def data(name: str, text: str) -> str:
    """Return JSON as an element of a page: nothing in it ends the element.

    Raises:
        ValueError: it is no JSON.
    """
    inert = json.dumps(json.loads(text), separators=(",", ":")).replace("<", r"\u003c")
    return f'<script type="application/json" id="{attribute(name)}">{inert}</script>'


FILTERS = {"anchor": anchor, "attribute": attribute, "cell": cell, "code": code, "digits": digits, "plain": plain}
"""Filters for values in a page; every value that is not a number goes through one."""
