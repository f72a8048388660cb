"""Verdicts on figures: new tables against reference tables, and `draw(reference table)` against the reference picture.

A figure has passed, failed, or is not comparable: its tables agree, but its picture is another one, as other versions
of what draws may make it.
"""

import json
from collections import Counter
from concurrent.futures import ProcessPoolExecutor
from contextlib import contextmanager
from itertools import repeat
from pathlib import Path
from tempfile import TemporaryDirectory

from vibroimpact.figures.plotting.versions import drawing_versions
from vibroimpact.tables import read
from vibroimpact_pipeline.figure_check import pictures
from vibroimpact_pipeline.figure_check.table_distances import compare, printed_distances
from vibroimpact_pipeline.specs import each

PASSED, FAILED, NOT_COMPARABLE = "passed", "failed", "not comparable"
OTHER_VERSIONS = "other versions drew the reference, see pictures.json, and these make another picture of its table"
SUMS = "pictures.json"
"""File of a reference set with the sums of PDF and SVG by figure, and the versions that drew them."""


def compared_files(figure: str, spec: dict) -> dict[str, tuple[str, str]]:
    """Return file name in the reference set and path in a build by name of each compared table of a figure."""
    return {
        name: (f"{figure}.csv" if name == "csv" else f"{figure}.{name}.csv", table["file"])
        for name, table in spec["tables"].items()
        if any("compared" in column for column in each(table["columns"]).values())
    }


def reference_sums(reference) -> dict[str, dict]:
    path = Path(reference) / SUMS
    return json.loads(path.read_text(encoding="utf-8")) if path.is_file() else {}


def check_all(figures: dict, reference, build, processes: int = 1) -> list[dict]:
    """Return verdicts on all given figures and those that have a reference, by name."""
    known = [*Path(reference).glob("*.png"), *Path(reference).glob("published/*.csv")]
    figures = sorted(({path.stem: None for path in known} | figures).items())
    with ProcessPoolExecutor(processes) as pool:
        return list(pool.map(check, *zip(*figures, strict=True), repeat(reference), repeat(build)))


def check(figure: str, spec: dict | None, reference, build) -> dict:
    """Return the verdict on one figure as JSON data; a damaged file fails this figure alone.

    Args:
        spec: its SPEC, and as "module" what draws it; None for one that is no longer made.
        reference: folder of the reference set. build: folder in which results/ lies, up to date.

    Returns keys figure, stem (path of its pictures in the build, without their endings), module, files (of each table
    that is compared its name in the reference set, and its path in the build), status, reasons (one line each),
    distance (the largest, of which 1 is the limit), tables (see `tables.compare`, with the table's name).
    """
    verdict = {
        "figure": figure,
        "stem": f"results/figures/{figure}",
        "module": None,
        "files": {},
        "status": FAILED,
        "reasons": [],
        "distance": 0.0,
        "tables": [],
    }
    if spec is None:
        return verdict | {"reasons": ["not built: the config has no such figure"]}
    reference, build, reasons, files = Path(reference), Path(build), verdict["reasons"], compared_files(figure, spec)
    plotted = spec["tables"].get("csv", {"file": f"{verdict['stem']}.csv"})
    verdict |= {"module": spec["module"], "files": files, "stem": plotted["file"].removesuffix(".csv")}
    built = {kind: build / f"{verdict['stem']}.{kind}" for kind in pictures.KINDS}
    published = [reference / file for file in (f"{figure}.png", *(file for file, _ in files.values()))]
    new_files = [*built.values(), *(build / path for _, path in files.values())]
    for reason, paths in (("no reference", published), ("not built", new_files)):
        if missing := [path.name for path in paths if not path.is_file()]:
            reasons.append(f"{reason}: {', '.join(missing)}")
    if reasons:
        return verdict
    old, new = {}, {}
    for name, (file, path) in files.items():
        with _errors_as_reasons(reasons, f"{file}: unreadable"):
            old[name], new[name] = read(reference / file), read(build / path)
            found, distances = compare(old[name], new[name], each(spec["tables"][name]["columns"]))
            reasons += [f"{file}: {reason}" for reason in found]
            verdict["tables"] += [{"table": file, **one} for one in distances]
    printed = reference / f"published/{figure}.csv"
    if printed.is_file():
        with _errors_as_reasons(reasons, f"published/{printed.name}: unreadable"):
            found, distances = printed_distances(read(printed), new["csv"])
            reasons += [f"published/{printed.name}: {reason}" for reason in found]
            verdict["tables"] += [{"table": f"published/{printed.name}", **one} for one in distances]
    others = []
    with _errors_as_reasons(reasons, "picture: cannot be read or drawn"), TemporaryDirectory() as folder:
        # Where the tables are equal, the built picture is what today's `draw` makes of the reference's tables.
        equal = all(name in new and old[name].equals(new[name]) for name in files)
        today = pictures.sums(built if equal else pictures.draw(spec["module"], old, figure, folder))
        known = reference_sums(reference).get(figure, {})
        before = known | pictures.sums({"png": published[0]})
        others = [kind for kind in pictures.KINDS if today[kind] != before.get(kind)]
        if pictures.is_blank(built["png"]):
            reasons.append("picture: blank")
        if others and known.get("drawn with") == drawing_versions():
            reasons.append(f"picture: `draw` makes another {', '.join(others)} of the reference's tables")
    far = max((one["distance"] for one in verdict["tables"]), default=0.0)
    return verdict | {"status": FAILED if reasons else NOT_COMPARABLE if others else PASSED, "distance": far}


@contextmanager
def _errors_as_reasons(reasons, what):
    """Turn any error into a reason: libraries raise many types for a damaged file."""
    try:
        yield
    except Exception as error:
        reasons.append(f"{what}: {' '.join(str(error).split()) or type(error).__name__}")


def ordered(verdicts: list[dict]) -> list[dict]:
    """Sort verdicts: failures first, then by distance, then by name."""
    order = [FAILED, NOT_COMPARABLE, PASSED]
    return sorted(verdicts, key=lambda one: (order.index(one["status"]), -one["distance"], one["figure"]))


def line(verdict: dict) -> str:
    """Return a line on a figure, with the first reason why it has not passed."""
    reasons = verdict["reasons"] or [OTHER_VERSIONS] * (verdict["status"] == NOT_COMPARABLE)
    more = f" ({len(reasons) - 1} more on the page)" * (len(reasons) > 1)
    return ": ".join([verdict["figure"], verdict["status"], *reasons[:1]]) + more


def lines(verdicts: list[dict]) -> list[str]:
    """Return a line per figure that did not pass, and a summary."""
    counts = Counter(verdict["status"] for verdict in verdicts)
    summary = ", ".join(f"{n} {status}" for status, n in counts.items())
    far = max((verdict["distance"] for verdict in verdicts), default=0.0)
    failures = [line(verdict) for verdict in ordered(verdicts) if verdict["status"] != PASSED]
    return [*failures, f"{len(verdicts)} figures: {summary}; largest distance {far:.2g} of its limit"]


def has_failed(verdicts: list[dict], strict: bool = False) -> bool:
    """Return True if a figure failed, if there was nothing to check or, if strict, if one could not be compared."""
    failures = (FAILED, NOT_COMPARABLE) if strict else (FAILED,)
    return not verdicts or any(verdict["status"] in failures for verdict in verdicts)
