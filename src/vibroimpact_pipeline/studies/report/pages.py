"""Make the pages of the report in Markdown, from documents and templates, with the numbers of this build."""

import json
import re
from html import escape
from pathlib import Path
from urllib.parse import quote

import jinja2
import yaml

from vibroimpact.figures.plotting.markdown import code, digits, one_line, plain
from vibroimpact_pipeline import data_dictionary
from vibroimpact_pipeline.html.figure_texts import figure_texts
from vibroimpact_pipeline.studies.report.live import live_data, map_data, verdict_data, verdict_dots

TEMPLATES = "report/pages"
NUMBER = re.compile(r"\[(?P<number>−?[\d.]+)\]\((?:studies/)?numbers\.yaml#(?P<key>[\w.-]+)\)")
"""Matches a number in a document with the link to its key in numbers.yaml."""
RUN_TIMES = "| times"
"""End of each place in numbers.yaml that gives a ratio of run times: the table column `times`."""
PICTURE = re.compile(r"(?P<text>!?\[[^\]]*\])\((?:\.\./)+results/\w+/(?P<name>\w+)\.png\)")
"""Matches a figure in a document, shown with a caption or linked."""
LIVE = re.compile(r"<!-- live: (?P<part>\w+) -->\n(?P<still>.*?)(?=\n\n)", re.DOTALL)
"""Matches the marker of a part in report/parts, and the text that replaces the part in print or without data."""
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
"""Template of a figure in reStructuredText, since the report of Snakemake also uses the captions in this format."""


class Pages:
    """Make the pages of the report.

    Parameters
    ----------
    root
        The checkout.
    results
        A `Results` object, which reads the results of this build.
    config
        The validated config.
    shown
        For each group of figures, the names of the figures.
    tables
        Names of the result files that readers can download. Files of figures are not included.
    """

    def __init__(self, root, results, config: dict, shown: dict, tables=()):
        self.root, self.results = Path(root), results
        self.names = sorted(path.stem for path in (self.root / TEMPLATES).glob("*.md"))
        self.chapter = shown.get("chapter", [])
        self.pictures = {figure for group in shown.values() for figure in group}
        self.about = figure_texts(config)
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
            "number": self.number,
            "places": self.places,
            "equations": yaml.safe_load((self.root / "report/report.yaml").read_text(encoding="utf-8"))["equations"],
            "table": table,
            "data": data,
            "dictionary": lambda of_figures: data_dictionary.page(*data_dictionary.read(), of_figures),
            "live_data": lambda: live_data(config),
            "map_data": lambda: map_data(results, config),
            "verdict_data": lambda: verdict_data(results, config),
            "verdict_dots": lambda: verdict_dots(results),
        }

    def filled(self, name: str) -> str:
        """Return a page of report/pages with its template filled from results."""
        return self.environment.get_template(f"pages/{name}.md").render()

    def with_numbers(self, text: str, paper: bool = False) -> str:
        """Return a document with the numbers and figures of this build.

        Unless `paper` is True, each number of this build links to its source. A number that this build lacks stays as
        it is written in the document.
        """
        if not paper:
            text = LIVE.sub(lambda found: self._live(**found.groupdict()), text)
        text = NUMBER.sub(lambda found: self._number(paper, **found.groupdict()), text)
        return PICTURE.sub(lambda found: self._picture(paper, **found.groupdict()), text)

    def number(self, key: str) -> tuple[float, str] | None:
        """Return value and source of a number in numbers.yaml, or None if this build lacks the number.

        Ratios of run times are rounded to two digits.
        """
        try:
            value = float(self.results.value(self.places[key]))
        except (LookupError, TypeError, ValueError, StopIteration, OSError):
            return None
        if self.places[key].endswith(RUN_TIMES):
            value = float(f"{value:.2g}")
        return value, f"results/{self.places[key].removeprefix('percent | ')}"

    def _number(self, paper, number, key):
        found = self.number(key)
        if found is None:
            return number
        shown = f"{found[0]:.{len(number.partition('.')[2])}f}".replace("-", "−")
        return shown if paper else f"[{shown}](#number-{anchor(key)})"

    def _picture(self, paper, text, name):
        if text.startswith("!"):
            if name not in self.pictures:
                return ""
            if paper:
                return f"{text}(figures/{name}.svg)"
            return SHOWN.format(name=quote(name), alt=one_line(self.about[name]["alt"]), caption=text[2:-1])
        return text[1:-1] if paper or name not in self.pictures else f"{text}(#{name})"

    def plates(self) -> str:
        """Return the chapter's figures for the end of the article.

        Figure 10.1 is omitted, since the text of the article shows this figure.
        """
        shown = (name for name in self.chapter if name != "fig10_01")
        plates = [f"![{plain(self.about[name]['title'])}](../results/figures/{name}.png)" for name in shown]
        return "\n\n".join(["\n## The figures of the chapter", *plates]) if plates else ""

    def _live(self, part, still):
        try:
            return f"```{{raw}} html\n{self.environment.get_template(f'parts/{part}.html').render()}\n```"
        except OSError:
            return still

    def figure(self, name: str, level: int = 2) -> str:
        """Return a section on a figure, with its title, equations, picture, files and origin."""
        about, record = self.about[name], self.results.provenance(name)
        files = self.results.files(name)
        links = [
            f"[{kind.upper() if path.suffix == f'.{kind}' else plain(kind)}](beside:figures/{quote(path.name)})"
            for kind, path in files.items()
        ]
        if self.results.notebook(name):
            links.append(f"[notebook](beside:notebooks/{quote(name)}.html)")
        if "csv" in files:
            page = "data_figures" if files["csv"].parent.name == "figures" else "data"
            links.append(f"[meaning of the columns]({page}.md)")
        origin = [plain(about["method"])]
        if record.get("commit"):
            origin.append(f"commit {code(record['commit'][:12])} ({plain(record['tree'])} tree)")
        if record.get("config"):
            origin.append(f"config {', '.join(map(code, record['config']))}")
        origin += [f"{plain(part)} {plain(number)}" for part, number in record["versions"].items()]
        caption = " ".join(about["caption"].split())
        picture = FIGURE.format(name=quote(name), alt=one_line(about["alt"]), caption=caption)
        return "\n\n".join(
            [
                f"({anchor(name)})=\n{'#' * level} {plain(about['title'])}",
                *(f"$$\n{formula.strip()}\n$$" for formula in about.get("equations", [])),
                f"``````````{{eval-rst}}\n{picture}\n``````````",
                f"**Files:** {' · '.join(links)}",
                f"**Origin:** {'; '.join(origin)}",
            ]
        )


def table(frame, heads: dict, number: int = 3) -> str:
    """Return columns of a DataFrame as a Markdown table with `number` significant digits.

    `heads` maps the name of each column of the result to the heading of the column.
    """
    rows = [[digits(value, number) for value in row] for row in frame[list(heads)].itertuples(index=False)]
    return "\n".join("| " + " | ".join(line) + " |" for line in [heads.values(), ["---"] * len(heads), *rows])


def cell(text) -> str:
    """Return a text as Markdown for a table cell, on one line and with vertical bars escaped."""
    return re.sub(r"\s+", " ", str(text)).replace("|", r"\|").strip()


def anchor(name) -> str:
    """Return a name in a form that is valid as an HTML anchor."""
    return re.sub(r"[^\w-]", "-", str(name))


def attribute(text) -> str:
    """Return a text on one line, escaped for HTML attributes and elements."""
    return escape(one_line(text))


def data(name: str, text: str) -> str:
    """Return JSON as a script element of a page; the character < is escaped, so that no text can end the element.

    Raises
    ------
    ValueError
        If the text is not JSON.
    """
    inert = json.dumps(json.loads(text), separators=(",", ":")).replace("<", r"\u003c")
    return f'<script type="application/json" id="{attribute(name)}">{inert}</script>'


FILTERS = {"anchor": anchor, "attribute": attribute, "cell": cell, "code": code, "digits": digits, "plain": plain}
"""Filters for the page templates; every value that is not a number must pass through a filter."""
