"""Verdicts on figures: new tables against reference tables, and `draw(reference table)` against the reference picture.

A figure has passed, failed, or is not comparable: its tables agree, but other versions drew the reference's picture.
"""

import json
from collections import Counter
from concurrent.futures import ProcessPoolExecutor
from contextlib import contextmanager
from itertools import repeat
from pathlib import Path
from tempfile import TemporaryDirectory

from vibroimpact.figures.kit.tables import read
from vibroimpact_pipeline.figure_check import pictures
from vibroimpact_pipeline.figure_check.tables import compare
from vibroimpact_pipeline.specs import each

PASSED, FAILED, NOT_COMPARABLE = "passed", "failed", "not comparable"
OTHER_VERSIONS = "picture not compared: other versions drew that of the reference, see pictures.json"
SUMS = "pictures.json"
"""File of a reference set with the sums of PDF and SVG by figure, and the versions that drew them."""


def kept(figure: str, spec: dict) -> dict[str, tuple[str, str]]:
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
    """Return verdicts on all figures that a config makes (`specs.made`) or that have a reference, by name."""
    asked = sorted(({path.stem: None for path in Path(reference).glob("*.png")} | figures).items())
    with ProcessPoolExecutor(processes) as pool:
        return list(pool.map(check, *zip(*asked, strict=True), repeat(reference), repeat(build)))


def check(figure: str, spec: dict | None, reference, build) -> dict:
    """Return the verdict on one figure as JSON data; a damaged file fails this figure alone.

    Args:
        spec: its SPEC, and as "module" what draws it; None for one that is no longer made.
        reference: folder of the reference set. build: folder in which results/ lies, up to date.

    Returns keys figure, module, files (of each table that is compared its name in the reference set, and its path in
    the build), status, reasons (one line each), tables (see `tables.compare`, with the table's name).
    """
    verdict = {"figure": figure, "module": None, "files": {}, "status": FAILED, "reasons": [], "tables": []}
    if spec is None:
        return verdict | {"reasons": ["not built: the config has no such figure"]}
    reference, build, reasons = Path(reference), Path(build), verdict["reasons"]
    verdict["module"], verdict["files"] = spec["module"], kept(figure, spec)
    png, built = reference / f"{figure}.png", {kind: f"results/figures/{figure}.{kind}" for kind in pictures.KINDS}
    published = [png, *(reference / file for file, _ in verdict["files"].values())]
    made = [build / path for path in [*built.values(), *(path for _, path in verdict["files"].values())]]
    for said, paths in (("no reference", published), ("not built", made)):
        if missing := [path.name for path in paths if not path.is_file()]:
            reasons.append(f"{said}: {', '.join(missing)}")
    if reasons:
        return verdict
    old, new = {}, {}
    for name, (file, path) in verdict["files"].items():
        with _told(reasons, f"{file}: unreadable"):
            old[name], new[name] = read(reference / file), read(build / path)
            said, distances = compare(old[name], new[name], each(spec["tables"][name]["columns"]))
            reasons += [f"{file}: {reason}" for reason in said]
            verdict["tables"] += [{"table": file, **one} for one in distances]
    if len(new) == len(verdict["files"]):
        paths = {kind: build / path for kind, path in built.items()}
        comparable = _compare_pictures(reasons, figure, spec["module"], png, paths, old, new)
        verdict["status"] = FAILED if reasons else PASSED if comparable else NOT_COMPARABLE
    return verdict


@contextmanager
def _told(reasons, what):
    """Turn any error into a reason: libraries raise many types for a damaged file."""
    try:
        yield
    except Exception as error:
        reasons.append(f"{what}: {' '.join(str(error).split()) or type(error).__name__}")


def _compare_pictures(reasons, figure, module, png, built, old, new):
    """Append reasons; return True if the versions in use drew the picture of the reference.

    Where the tables are equal, the built picture is what today's `draw` makes of the reference's table.
    """
    known = reference_sums(png.parent).get(figure, {})
    comparable = known.get("drawn with") == pictures.environment()
    with TemporaryDirectory() as folder, _told(reasons, "picture: cannot be read or drawn"):
        found, after = pictures.sums(built), pictures.pixels(built["png"].read_bytes())
        if (after == after[0, 0]).all():
            reasons.append("picture: blank")
        if not comparable:
            return False
        if not all(old[name].equals(new[name]) for name in old):
            drawn = pictures.draw(module, old, figure, folder)
            found, after = pictures.sums(drawn), pictures.pixels(drawn["png"].read_bytes())
        before = pictures.pixels(png.read_bytes())
        if before.shape != after.shape:
            reasons.append("picture: {1} x {0} pixels instead of {3} x {2}".format(*after.shape[:2], *before.shape))
        elif changed := int((before != after).any(axis=-1).sum()):
            reasons.append(f"picture: `draw` makes {changed} other pixels of the reference's table")
        others = [kind for kind in ("pdf", "svg") if known.get(kind) != found[kind]]
        reasons += [f"{kind}: `draw` makes another one of the reference's table" for kind in others]
    return comparable


def share(verdict: dict) -> float:
    """Return the largest distance of a figure's tables as a share of its limit."""
    return max(
        (one["distance"] / one["limit"] for one in verdict["tables"] if one["distance"] and one["limit"]), default=0
    )


def ordered(verdicts: list[dict]) -> list[dict]:
    """Sort verdicts: failures first, then by distance, then by name."""
    order = [FAILED, NOT_COMPARABLE, PASSED]
    return sorted(verdicts, key=lambda one: (order.index(one["status"]), -share(one), one["figure"]))


def command(figures) -> str:
    """Return the command that accepts figures as they are now."""
    return f'make accept REASON="why" FIGURES="{" ".join(figures)}"'


def lines(verdicts: list[dict]) -> list[str]:
    """Return one line per figure that did not pass, with its first reason, and a summary line."""
    said = []
    for verdict in (verdict for verdict in ordered(verdicts) if verdict["status"] != PASSED):
        first, *more = verdict["reasons"] or [OTHER_VERSIONS]
        said.append(
            f"{verdict['figure']}: {verdict['status']}: {first}"
            + f" ({len(more)} more reasons on the page)" * bool(more)
        )
    counts = Counter(verdict["status"] for verdict in verdicts)
    far = max(map(share, verdicts), default=0.0)
    summary = f"{len(verdicts)} figures: " + ", ".join(f"{n} {status}" for status, n in counts.items())
    return [*said, f"{summary}; largest distance {far:.2g} of its limit"]


def has_failed(verdicts: list[dict], strict: bool = False) -> bool:
    """Return True if a figure failed, if there was nothing to check or, if strict, if one could not be compared."""
    failures = (FAILED, NOT_COMPARABLE) if strict else (FAILED,)
    return not verdicts or any(verdict["status"] in failures for verdict in verdicts)
