"""Comparison of new figures with a reference set: numbers first, then what is drawn, then pixels.

The verdict on a figure is "passed", "failed", or "not comparable": numbers and artists agree, but the reference was
drawn by other versions of Matplotlib or FreeType, so that pixels tell nothing.
"""

import json
import math
from collections import Counter
from pathlib import Path

import yaml

from vibroimpact.figures.kit import tables
from vibroimpact_pipeline.figure_check import pictures
from vibroimpact_pipeline.figure_check.artists import differences, without_places
from vibroimpact_pipeline.figure_check.tables import UNITS, Rules, differences_in_structure, distances

PASSED, FAILED, NOT_COMPARABLE = "passed", "failed", "not comparable"
UNREADABLE = OSError, ValueError, SyntaxError
"""What pandas, json and Pillow raise for files that are not what their names say."""


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


def check_all(figures, reference, new, limits: dict) -> list[dict]:
    """Verdicts on the given figures and on all others that have a reference, by name; see `check`."""
    return [check(figure, reference, new, limits) for figure in sorted({*figures} | figures_in(reference))]


def check(figure: str, reference, new, limits: dict) -> dict:
    """Verdict on one figure, as JSON data.

    Args:
        figure: its name, such as "fig10_06".
        reference, new: folders with the files of `files_of`.
        limits: see `tolerances`.

    Returns keys figure, status, reasons (one line each), tables (per column: distance, unit, limit, kind and where),
    artists (distance, limit), picture (status, distance, limit, versions). Distances are there on a pass too; one
    that is infinite, or could not be taken, is None.
    """
    verdict = {"figure": figure, "status": FAILED, "reasons": [], "tables": [], "artists": {}, "picture": {}}
    old_files, new_files = files_of(figure, reference), files_of(figure, new)
    names = dict.fromkeys([*old_files, *new_files])
    for files, what in ((old_files, "no reference"), (new_files, "not built")):
        missing = [name for name in names if name not in files or not files[name].is_file()]
        verdict["reasons"] += [f"{what}: {', '.join(missing)}"] if missing else []
    if verdict["reasons"]:
        return verdict
    try:
        _compare(verdict, [(name, old_files[name], new_files[name]) for name in names], limits)
    except UNREADABLE as error:
        verdict["reasons"].append(f"unreadable: {' '.join(str(error).split())}")
    if not verdict["reasons"]:
        comparable = verdict["picture"]["status"] != NOT_COMPARABLE
        verdict["status"] = PASSED if comparable else NOT_COMPARABLE
    return verdict


def _compare(verdict, pairs, limits):
    for name, old, new in pairs:
        if name.endswith(".csv"):
            _compare_tables(verdict, name, tables.read(old), tables.read(new), limits)
    old, new = (_artists(path) for path in _pair(pairs, ".artists.json"))
    simulated = limits["artists"]["simulated"].get(verdict["figure"], [])
    _compare_artists(verdict, *(without_places(each, simulated) for each in (old, new)), limits["artists"]["limit"])
    versions = {"drawn with": new["drawn with"], "reference drawn with": old["drawn with"]}
    if old["drawn with"] != new["drawn with"]:
        verdict["picture"] = {"status": NOT_COMPARABLE, **versions}
    else:
        measure = "simulated" if verdict["figure"] in limits["picture"]["simulated"]["figures"] else "drawn"
        settings = limits["picture"][measure]
        verdict["picture"] = {"status": FAILED, "distance": None, "limit": settings["limit"], **versions}
        _compare_pictures(verdict, *_pair(pairs, ".png"), measure, settings["limit"])


def _pair(pairs, suffix):
    return next((old, new) for name, old, new in pairs if name.endswith(suffix))


def _artists(path):
    return json.loads(path.read_text(encoding="utf-8"))


def rules_of(table: str, limits: dict) -> Rules:
    """How the columns of a table are compared."""
    measures = {kind: entry.get("measure", "largest") for kind, entry in limits["tables"].items()}
    return Rules(limits["columns"].get(table, {}), measures)


def _compare_tables(verdict, name, old, new, limits):
    rules = rules_of(name.removesuffix(".csv"), limits)
    different = differences_in_structure(old, new, rules)
    verdict["reasons"] += [f"{name}: {line}" for line in different]
    for found in [] if different else distances(old, new, rules):
        limit = limits["tables"][found.kind]["limit"] if found.kind else None
        unit = UNITS[rules.measures.get(found.kind, "largest")]
        verdict["tables"].append(
            {"table": name, "column": found.column, "kind": found.kind, "limit": limit, "unit": unit}
            | {"distance": _finite(found.distance), "where": found.row}
            | {"reference": _finite(found.reference), "new": _finite(found.new)}
        )
        if found.kind is None:
            verdict["reasons"].append(f"{name}: no limit is stated for column {found.column}")
        elif not found.distance <= limit:
            verdict["reasons"].append(
                f"{name}: {found.column} is off by {found.distance:.2g} {unit}, limit {limit:g} "
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


def _compare_pictures(verdict, old, new, measure, limit):
    old, new = (pictures.grey(path) for path in (old, new))
    if old.shape != new.shape:
        sizes = ["{1} x {0} pixels".format(*picture.shape) for picture in (new, old)]
        verdict["reasons"].append(f"picture: {sizes[0]} instead of {sizes[1]}")
        return
    far = pictures.MEASURES[measure](old, new)
    verdict["picture"] |= {"status": PASSED if far <= limit else FAILED, "distance": far}
    if far > limit:
        verdict["reasons"].append(f"picture: {pictures.SAID[measure].format(far)}, limit {limit:g}")


def _finite(value):
    return value if isinstance(value, str) or math.isfinite(value) else None


def largest(verdict: dict) -> float | None:
    """The largest distance of a figure as a share of its limit; None if one is infinite or could not be taken."""
    measured = [*verdict["tables"], verdict["artists"], verdict["picture"]]
    measured = [entry for entry in measured if entry.get("limit") is not None]
    shares = [None if entry["distance"] is None else entry["distance"] / entry["limit"] for entry in measured]
    return None if not shares or None in shares else max(shares)


def lines(verdicts: list[dict]) -> list[str]:
    """One line per figure that did not pass, with its first reason, and a last line that sums up."""
    said = []
    for verdict in verdicts:
        first, *more = verdict["reasons"] or ["picture drawn by other versions of Matplotlib or FreeType"]
        if verdict["status"] != PASSED:
            rest = f" (and {len(more)} more)" if more else ""
            said.append(f"{verdict['figure']}: {verdict['status']}: {first}{rest}")
    counts = Counter(verdict["status"] for verdict in verdicts)
    shares = [share for share in map(largest, verdicts) if share is not None]
    closest = f"; largest distance {max(shares):.2g} of its limit" if shares else ""
    return [*said, f"{len(verdicts)} figures: " + ", ".join(f"{n} {status}" for status, n in counts.items()) + closest]


def has_failed(verdicts: list[dict]) -> bool:
    """Whether any figure failed, or there was nothing to check."""
    return not verdicts or any(verdict["status"] == FAILED for verdict in verdicts)
