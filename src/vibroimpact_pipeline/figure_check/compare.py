"""Comparison of new figures with a reference set: numbers first, then what is drawn, then pictures.

The verdict on a figure is "passed", "failed", or "not comparable": numbers and artists agree, and the pictures by and
large, but the reference was drawn by other versions of Matplotlib or FreeType, so that its pixels tell no more.
"""

import json
import math
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import yaml

from vibroimpact.figures.kit import tables
from vibroimpact_pipeline.figure_check import drawings
from vibroimpact_pipeline.figure_check.artists import differences, nothing_shown, without_places
from vibroimpact_pipeline.figure_check.origins import same_rounding
from vibroimpact_pipeline.figure_check.tables import UNITS, Rules, differences_in_structure, distances, lacks
from vibroimpact_pipeline.figure_check.vector_files import letters_of_pdf, letters_of_texts, texts_of
from vibroimpact_pipeline.figure_check.verdicts import FAILED, NOT_COMPARABLE, PASSED

VECTORS = "pdf", "svg"
"""Kinds of pictures that are built and not kept: they are compared with the PNG beside them."""


def tolerances(columns: dict) -> dict:
    """The table of limits and their reasons, see tolerances.yaml, with how each column is compared.

    columns: by table, see `data_dictionary.compared`.
    """
    limits = yaml.safe_load(Path(__file__).with_name("tolerances.yaml").read_text(encoding="utf-8"))
    return limits | {"columns": columns}


def figures_in(folder) -> set[str]:
    """Names of the figures of a reference set."""
    return {path.name.removesuffix(".artists.json") for path in Path(folder).glob("*.artists.json")}


def files_of(figure: str, folder) -> dict[str, Path]:
    """The files of a figure that a reference keeps, by name: picture, artists, and its tables (maybe several)."""
    folder = Path(folder)
    found = [folder / f"{figure}.png", folder / f"{figure}.artists.json"]
    found += sorted({*folder.glob(f"{figure}.csv"), *folder.glob(f"{figure}[._]*.csv")})
    return {path.name: path for path in found}


def all_figures(figures, reference) -> list[str]:
    """The figures that are checked: the given ones and all others that have a reference, by name; see `check`."""
    return sorted({*figures} | figures_in(reference))


def check(figure: str, reference, new, limits: dict) -> dict:
    """Verdict on one figure, as JSON data. Whatever a file holds, it is a verdict on this figure alone.

    Args:
        figure: its name, such as "fig10_06".
        reference, new: folders with the files of `files_of`; in the new one also those of VECTORS.
        limits: see `tolerances`.

    Returns keys figure, status, reasons (one line each), tables (per column and measure: distance, unit, limit, kind
    and where), artists (distance, limit), picture (status, versions, and per file and measure distance and limit),
    same rounding (whether a machine like the one of the reference has computed the figure). Distances are there on a
    pass too; one that is infinite, or could not be taken, is None.
    """
    verdict = {"figure": figure, "status": FAILED, "reasons": [], "tables": [], "artists": {}, "picture": {}}
    verdict["same rounding"] = same_rounding(figure, reference, new)
    old_files, new_files = files_of(figure, reference), files_of(figure, new)
    vectors = {kind: Path(new) / f"{figure}.{kind}" for kind in VECTORS}
    declared = [f"{figure}.csv"] if limits["columns"].get(figure) else []
    names = list(dict.fromkeys([*old_files, *new_files, *declared]))
    for what, paths in (("no reference", old_files), ("not built", new_files)):
        missing = [name for name in names if name not in paths or not paths[name].is_file()]
        missing += [path.name for path in vectors.values() if what == "not built" and not path.is_file()]
        verdict["reasons"] += [f"{what}: {', '.join(missing)}"] if missing else []
    if not verdict["reasons"]:
        _compare(verdict, {name: (old_files[name], new_files[name]) for name in names}, vectors, limits)
    if not verdict["reasons"]:
        verdict["status"] = PASSED if verdict["picture"]["status"] == PASSED else NOT_COMPARABLE
    return verdict


def _compare(verdict, pairs, vectors, limits):
    for name, files in pairs.items():
        if name.endswith(".csv"):
            with _noted(verdict, name):
                _compare_tables(verdict, name, *map(tables.read, files), limits)
    artists, png = (pairs[f"{verdict['figure']}.{kind}"] for kind in ("artists.json", "png"))
    with _noted(verdict, artists[1].name):
        old, new = map(_artists, artists)
        verdict["reasons"] += nothing_shown(new)
        simulated = limits["artists"]["simulated"].get(verdict["figure"], [])
        _compare_artists(verdict, *(without_places(each, simulated) for each in (old, new)), limits["artists"]["limit"])
        with _noted(verdict, "pdf"):
            _compare_letters(verdict, new, vectors["pdf"])
        with _noted(verdict, "picture"):
            versions = {"reference drawn with": old["drawn with"], "drawn with": new["drawn with"]}
            verdict["picture"] = {"status": FAILED, **versions}
            same = old["drawn with"] == new["drawn with"]
            found, reasons = drawings.compare(verdict["figure"], *png, vectors, same, limits["picture"])
            verdict["picture"] |= found
            verdict["reasons"] += reasons


@contextmanager
def _noted(verdict, name) -> Iterator[None]:
    """Make a reason of whatever is raised: for a spoilt file libraries raise errors of all kinds."""
    try:
        yield
    except Exception as error:
        said = " ".join(str(error).split()) or type(error).__name__
        verdict["reasons"].append(f"{name}: unreadable: {said}")


def _artists(path):
    return json.loads(path.read_text(encoding="utf-8"))


def rules_of(table: str, limits: dict, same: bool = False) -> Rules:
    """How the columns of a table are compared.

    same: whether both were computed on machines that round alike, where chance is no excuse.
    """
    by_kind = {kind: entry["limits"] for kind, entry in limits["tables"].items()}
    if same:
        by_kind |= dict.fromkeys(limits["same rounding"]["kinds"], limits["same rounding"]["limits"])
    return Rules(limits["columns"].get(table, {}), by_kind)


def _compare_tables(verdict, name, old, new, limits):
    table = name.removesuffix(".csv")
    rules = rules_of(table, limits, verdict["same rounding"])
    infinite = limits["infinite"].get(table, {}).get("columns", ())
    different = differences_in_structure(old, new, rules) or lacks(new, rules.columns, infinite)
    verdict["reasons"] += [f"{name}: {line}" for line in different]
    for found in [] if different else distances(old, new, rules):
        unit = UNITS[found.measure]
        verdict["tables"].append(
            {"table": name, "column": found.column, "kind": found.kind, "limit": found.limit, "unit": unit}
            | {"distance": _finite(found.distance), "where": found.row}
            | {"reference": _finite(found.reference), "new": _finite(found.new)}
        )
        if found.kind is None:
            verdict["reasons"].append(f"{name}: no limit is stated for column {found.column}")
        elif not found.distance <= found.limit:
            alike = ", rounded alike" if found.measure == "same" else ""
            verdict["reasons"].append(
                f"{name}: {found.column} is off by {found.distance:.2g} {unit}, limit {found.limit:g}{alike} "
                f"({found.row}: {shown(found.new)} instead of {shown(found.reference)})"
            )


def shown(value) -> str:
    """An entry of a table to read."""
    return value if isinstance(value, str) else f"{value:.9g}"


def _compare_artists(verdict, old, new, limit):
    old, new = ({name: part for name, part in artists.items() if name != "drawn with"} for artists in (old, new))
    found = differences(old, new)
    verdict["artists"] = {"distance": _finite(max((one.share for one in found), default=0.0)), "limit": limit}
    verdict["reasons"] += [str(one) for one in found if not one.share <= limit]


def _compare_letters(verdict, artists, pdf):
    """The letters of the PDF with those of the texts that its description shows."""
    expected, found = letters_of_texts(texts_of(artists)), letters_of_pdf(pdf)
    for what, letters in (("lacks", expected - found), ("has beside the figure's texts", found - expected)):
        if letters:
            verdict["reasons"].append(f"pdf: {what} the letters {''.join(sorted(letters.elements()))[:40]}")


def _finite(value):
    return value if isinstance(value, str) or math.isfinite(value) else None
