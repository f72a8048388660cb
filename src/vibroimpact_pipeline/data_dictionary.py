"""What every file of the results holds: the cards of the figures and docs/data.yaml, read together -> docs/data.md."""

import re
from dataclasses import dataclass, field
from itertools import groupby
from pathlib import Path

import yaml

from vibroimpact_pipeline.checkout import ROOT
from vibroimpact_pipeline.report.figure_texts import OWN

CARDS, DATA, PAGE = "report/figures.yaml", "docs/data.yaml", "docs/data.md"


@dataclass(frozen=True)
class File:
    """A kind of file among the results.

    paths: where such files are; {case} and the like stand for a word. about: what they hold. name: of the table of a
    figure, else blank. columns: meaning, unit and maybe values of each column, by name; own: names of those whose
    meaning is not shared. keys: meaning by the path of the key, with * for every entry. on_demand: the command by path,
    for what a plain build leaves alone.
    """

    paths: list[str]
    about: str
    name: str = ""
    columns: dict[str, dict] = field(default_factory=dict)
    own: list[str] = field(default_factory=list)
    keys: dict[str, str] = field(default_factory=dict)
    on_demand: dict[str, str] = field(default_factory=dict)

    def has(self, path: str) -> bool:
        """Whether a path, from the checkout, is one of these files."""
        return any(stands_for(pattern, path) for pattern in self.paths)


def stands_for(pattern: str, path: str) -> bool:
    """Whether a pattern with {words} matches a path."""
    return re.fullmatch(r"[\w-]+".join(map(re.escape, re.split(r"\{\w+\}", pattern))), path) is not None


def each(listed: dict) -> dict:
    """Entries by single name, of a list in which "C1, C2" stands for both."""
    return {name: entry or {} for names, entry in listed.items() for name in names.split(", ")}


def read(root) -> tuple[dict, dict]:
    """The cards, and docs/data.yaml."""
    return tuple(yaml.safe_load((Path(root) / name).read_text(encoding="utf-8")) for name in (CARDS, DATA))


def compared(cards: dict) -> dict[str, dict]:
    """How the figure check compares columns, by table and column: a kind of tolerances.yaml, or a kind by series."""
    return {
        name: {column: entry["compared"] for column, entry in each(table["columns"]).items() if "compared" in entry}
        for card, table in cards.items()
        for name, table in _tables(card, table).items()
    }


def files(cards: dict, data: dict) -> list[File]:
    """All kinds of files, those of figures first; figures of one's own have the tables of those they are drawn like."""
    shared = each(data["shared"])
    drawn = [card for card in cards if not card.startswith(OWN)]
    of_figures = [_file(name, table, shared) for card in drawn for name, table in _tables(card, cards[card]).items()]
    return of_figures + [_file("", entry, shared) for entry in data["files"]]


def _tables(card, entry):
    """The tables of a card by their names: the one it plots, and those beside it."""
    plotted = {card: {"about": entry["title"] + ".", **entry}} if "columns" in entry else {}
    return plotted | entry.get("tables", {})


def _file(name, entry, shared):
    listed = each(entry.get("columns", {}))
    return File(
        paths=entry.get("files", [f"results/figures/{name}.csv"]),
        about=entry["about"],
        name=name,
        columns={column: shared.get(column, {}) | own for column, own in listed.items()},
        own=[column for column, own in listed.items() if column not in shared or own.keys() - {"compared"}],
        keys=each(entry.get("keys", {})),
        on_demand=entry.get("on_demand", {}),
    )


def page(cards: dict, data: dict) -> str:
    """The data dictionary as Markdown."""
    listed = files(cards, data)
    figures, others = ([file for file in listed if bool(file.name) == drawn] for drawn in (True, False))
    parts = [
        HEAD,
        "## Units",
        _table(["unit", "meaning"], data["units"].items()),
        "## Names that mean the same in every file",
        _columns(each(data["shared"])),
        "## Tables of figures",
        *(part for file in figures for part in _section(f"### {file.name}", file)),
        "## Other files",
        *(part for file in others for part in _section(f"### {file.paths[0].removeprefix('results/')}", file)),
    ]
    return "\n\n".join(parts) + "\n"


HEAD = f"""\
# The data

What the files below `results/` hold, column by column. A quantity that a row does not have is left blank. The tables
of figures have a row per plotted point; every number has as many digits as tell it from its neighbours in double
precision. `{{case}}` and the like stand for a word. `python -m vibroimpact_pipeline.data_dictionary` writes this page
from `{DATA}` and the cards in `{CARDS}`; tests compare it with the files of a build, both ways."""


def _section(heading, file):
    """Heading, where the file is and what it holds, the shared columns by name, all others and keys with meaning."""
    places = [f"`{path}`" + _made_by(file, path) for path in file.paths]
    common = [f"`{name}`" for name in file.columns if name not in file.own]
    yield heading
    yield f"{', '.join(places)}: {file.about}"
    if common:
        yield f"Shared names: {', '.join(common)}."
    if file.own:
        yield _columns({name: file.columns[name] for name in file.own})
    if file.keys:
        yield _table(["key", "meaning"], ((f"`{key}`", said) for key, said in file.keys.items()))


def _made_by(file, path):
    return f" (made by `{file.on_demand[path]}`)" if path in file.on_demand else ""


def _columns(columns):
    return _table(
        ["column", "meaning", "unit"],
        ((f"`{name}`", _meaning(entry), entry["unit"]) for name, entry in columns.items()),
    )


def _meaning(entry):
    """What a column means, with the values it may have where these words do not say them."""
    meaning, values = entry["meaning"], entry.get("values", [])
    return meaning if all(value in meaning for value in values) else f"{meaning}: {'; '.join(values)}"


def _table(heads, rows):
    """A pipe table, with one row for all names that mean the same."""
    merged = ((", ".join(name for name, *_ in same), *rest) for rest, same in groupby(rows, lambda row: row[1:]))
    lines = [heads, ["---"] * len(heads), *merged]
    return "\n".join("| " + " | ".join(line) + " |" for line in lines)


def main() -> None:
    """Write the page of the checkout."""
    (ROOT / PAGE).write_text(page(*read(ROOT)), encoding="utf-8")


if __name__ == "__main__":
    main()
