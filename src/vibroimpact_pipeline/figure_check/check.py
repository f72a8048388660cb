"""Compare the tables and pictures of each figure with the reference set.

The new tables are compared with the reference tables. To compare the drawing code alone, the present code draws the
reference tables, and this picture is compared with the reference picture. If the two pictures differ, but the reference
picture was drawn with other library versions, the figure is not comparable.
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
from vibroimpact_pipeline.figure_check.table_distances import printed_distances, table_differences
from vibroimpact_pipeline.specs import each

PASSED, FAILED, NOT_COMPARABLE = "passed", "failed", "not comparable"
OTHER_VERSIONS = "the picture differs, but other library versions drew the reference (see pictures.json)"
SUMS = "pictures.json"
"""File in a reference set: for each figure, checksums of PDF and SVG, and the library versions that drew them."""


def compared_files(figure: str, spec: dict) -> dict[str, tuple[str, str]]:
    """Return, for each compared table of a figure, a pair (file in the reference set, path in a build)."""
    return {
        name: (f"{figure}.csv" if name == "csv" else f"{figure}.{name}.csv", table["file"])
        for name, table in spec["tables"].items()
        if any("compared" in column for column in each(table["columns"]).values())
    }


def reference_sums(reference) -> dict[str, dict]:
    """Return the checksums of the pictures in a reference set, by figure.

    The entry of a figure contains the checksums of its PDF and of its SVG. It also contains the library versions that
    drew the two files.
    """
    path = Path(reference) / SUMS
    return json.loads(path.read_text(encoding="utf-8")) if path.is_file() else {}


def check_all(figures: dict, reference, build, processes: int = 1) -> list[dict]:
    """Return the verdicts on all figures in `figures` and in the reference set, sorted by the name of the figure.

    `figures` contains the SPEC (description) of each figure of the build by name.
    """
    known = [*Path(reference).glob("*.png"), *Path(reference).glob("published/*.csv")]
    figures = sorted(({path.stem: None for path in known} | figures).items())
    with ProcessPoolExecutor(processes) as pool:
        return list(pool.map(check, *zip(*figures, strict=True), repeat(reference), repeat(build)))


def check(figure: str, spec: dict | None, reference, build) -> dict:
    """Return the verdict on one figure as JSON data; a damaged file makes the figure fail.

    If the figure is no longer built, `spec` is None.

    Returns
    -------
    dict
        The verdict, with these keys:

        - figure: name of the figure.
        - stem: path of the pictures in the build, without suffix.
        - module: name of the drawing module, or None if the figure is no longer built.
        - files: for each compared table, a pair (file in the reference set, path in the build).
        - status: "passed", "failed" or "not comparable".
        - reasons: reasons for failure, each on one line.
        - tables: distances of the table columns from the reference, in units of the allowed distance.
        - distance: largest distance in `tables`.
    """
    verdict = {"figure": figure, "stem": f"results/figures/{figure}", "module": None, "files": {}}
    verdict |= {"status": FAILED, "reasons": [], "distance": 0.0, "tables": []}
    if spec is None:
        return verdict | {"reasons": ["not built: the config has no figure of this name"]}
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
            _add(verdict, file, table_differences(old[name], new[name], each(spec["tables"][name]["columns"])))
    printed = f"published/{figure}.csv"  # this table contains points that were read from the printed figure
    if (reference / printed).is_file():
        with _errors_as_reasons(reasons, f"{printed}: unreadable"):
            _add(verdict, printed, printed_distances(read(reference / printed), new["csv"]))
    others = []
    with _errors_as_reasons(reasons, "picture: cannot be read or drawn"):
        others = _other_pictures(verdict, reference, built, old, new)
    far = max((one["distance"] for one in verdict["tables"]), default=0.0)
    return verdict | {"status": FAILED if reasons else NOT_COMPARABLE if others else PASSED, "distance": far}


def _add(verdict, file, differences):
    reasons, distances = differences
    verdict["reasons"] += [f"{file}: {reason}" for reason in reasons]
    verdict["tables"] += [{"table": file, **one} for one in distances]


def _other_pictures(verdict, reference, built, old, new) -> list[str]:
    """Return the formats (png, pdf, svg) in which the picture differs from the reference.

    The function also adds reasons for failure to the verdict. A blank picture is a failure. A difference from the
    reference is a failure only if the reference was drawn with the installed library versions.
    """
    # If the tables are equal, the picture in the build already shows the reference tables.
    equal = all(name in new and old[name].equals(new[name]) for name in verdict["files"])
    with TemporaryDirectory() as folder:
        today = pictures.sums(built if equal else pictures.draw(verdict["module"], old, verdict["figure"], folder))
    known = reference_sums(reference).get(verdict["figure"], {})
    before = known | pictures.sums({"png": reference / f"{verdict['figure']}.png"})
    others = [kind for kind in pictures.KINDS if today[kind] != before.get(kind)]
    if all(low == high for low, high in pictures.load_png(built["png"].read_bytes()).getextrema()):
        verdict["reasons"].append("picture: blank")
    if others and known.get("drawn with") == drawing_versions():
        differ = f"picture: {', '.join(others)} drawn from the reference tables differs from the reference"
        verdict["reasons"].append(differ)
    return others


@contextmanager
def _errors_as_reasons(reasons, what):
    """Catch any error and append it to `reasons`, because reading a damaged file can raise many types of errors."""
    try:
        yield
    except Exception as error:
        reasons.append(f"{what}: {' '.join(str(error).split()) or type(error).__name__}")


def ordered(verdicts: list[dict]) -> list[dict]:
    """Sort verdicts by status, failures first, then from the largest to the smallest distance, then by name."""
    order = [FAILED, NOT_COMPARABLE, PASSED]
    return sorted(verdicts, key=lambda one: (order.index(one["status"]), -one["distance"], one["figure"]))


def line(verdict: dict) -> str:
    """Return one line for a figure: name, status and, if it did not pass, the first reason."""
    reasons = verdict["reasons"] or [OTHER_VERSIONS] * (verdict["status"] == NOT_COMPARABLE)
    more = f" ({len(reasons) - 1} more on the page)" * (len(reasons) > 1)
    return ": ".join([verdict["figure"], verdict["status"], *reasons[:1]]) + more


def lines(verdicts: list[dict]) -> list[str]:
    """Return one line for each figure that did not pass, and a summary line."""
    counts = Counter(verdict["status"] for verdict in verdicts)
    summary = ", ".join(f"{n} {status}" for status, n in counts.items())
    far = max((verdict["distance"] for verdict in verdicts), default=0.0)
    failures = [line(verdict) for verdict in ordered(verdicts) if verdict["status"] != PASSED]
    return [*failures, f"{len(verdicts)} figures: {summary}; largest distance {far:.2g} times its limit"]


def has_failed(verdicts: list[dict], strict: bool = False) -> bool:
    """Return True if a figure failed or if there are no verdicts.

    If `strict` is True, "not comparable" counts as failed.
    """
    failures = (FAILED, NOT_COMPARABLE) if strict else (FAILED,)
    return not verdicts or any(verdict["status"] in failures for verdict in verdicts)
