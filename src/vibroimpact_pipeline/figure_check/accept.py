"""Accept new figures as the reference set: show the changes, ask for a reason, record both.

Nothing else writes into the reference set.
"""

import argparse
import datetime
import json
import shutil
import sys
from pathlib import Path
from tempfile import TemporaryDirectory

from vibroimpact.figures.kit.tables import read
from vibroimpact_pipeline.figure_check import pictures
from vibroimpact_pipeline.figure_check.check import PASSED, SUMS, reference_sums
from vibroimpact_pipeline.figure_check.tables import UNITS
from vibroimpact_pipeline.results import replacing

HEADING = "# Changes of the reference set\n\nWritten by `make accept`, newest first.\n"
SHOWN = 8
"""Reasons shown per figure; the page has more, figure_check.json has all."""


def changed(verdicts: list[dict], figures=()) -> list[dict]:
    """Return the verdicts on the named figures, or on all that did not pass.

    Raises:
        ValueError: a name that no verdict has.
    """
    known = {verdict["figure"]: verdict for verdict in verdicts}
    if unknown := [figure for figure in figures if figure not in known]:
        raise ValueError(f"figures: unknown {', '.join(unknown)}; there are {', '.join(known)}")
    return [v for v in verdicts if (v["figure"] in figures if figures else v["status"] != PASSED)]


def summary(verdict: dict, pictures_only: bool = False) -> list[str]:
    """Return lines on the changes in one figure: numbers before and after unless these are kept, other reasons."""
    reasons = verdict["reasons"]
    said = [
        f"  {one['table']}, {one['column']}: before {one['reference']}, after {one['new']}, "
        f"difference {one['distance']} {UNITS[one['measure']]} ({one['where']})"
        for one in verdict["tables"]
        if one["distance"] != 0 and not pictures_only
    ]
    said += [f"  {reason}" for reason in reasons[:SHOWN]] + [f"  and {len(reasons) - SHOWN} more"] * (
        len(reasons) > SHOWN
    )
    return [f"{verdict['figure']}: {verdict['status']}", *said]


def accept(verdicts: list[dict], build, reference, reason: str, date: datetime.date, pictures_only=False) -> None:
    """Copy the tables of figures into the reference set, draw their pictures, and record the reason.

    A figure that is no longer built leaves the set.

    Args:
        verdicts: on these figures. build: folder in which results/ lies. reference: folder of the set.
        reason: one line. date: of the entry.
        pictures_only: keep the tables, and take the pictures that are drawn of them now.

    Raises:
        ValueError: the reason is empty. Nothing is written.
    """
    reason = " ".join(reason.split())
    if not reason:
        raise ValueError("reason: empty; say why the reference set changes")
    reference, build = Path(reference), Path(build)
    entries = [_entry(verdict, build) for verdict in verdicts]
    sums = reference_sums(reference)
    with TemporaryDirectory() as folder:
        for verdict in verdicts:
            figure = verdict["figure"]
            sums.pop(figure, None)
            if verdict["module"]:
                sums[figure] = _take(verdict, None if pictures_only else build, reference, folder)
            else:
                for path in reference.glob(f"{figure}.*"):
                    path.unlink()
    changes = reference / "CHANGES.md"
    earlier = changes.read_text(encoding="utf-8").removeprefix(HEADING) if changes.exists() else ""
    text = f"{HEADING}\n## {date:%Y-%m-%d}: {reason}\n\n" + "\n".join(entries) + "\n" + earlier
    for path, content in ((reference / SUMS, json.dumps(dict(sorted(sums.items())), indent=1) + "\n"), (changes, text)):
        with replacing(path) as partial:
            partial.write_text(content, encoding="utf-8")


def _take(verdict, build, reference, folder):
    """Put the files of a figure into the reference set (tables only if a build is given); return its sums."""
    figure, files = verdict["figure"], verdict["files"]
    for kept, path in files.values() if build else ():
        with replacing(reference / kept) as partial:
            shutil.copyfile(build / path, partial)
    tables = {name: read(reference / kept) for name, (kept, _) in files.items()}
    drawn = pictures.draw(verdict["module"], tables, figure, folder)
    with replacing(reference / f"{figure}.png") as partial:
        partial.write_bytes(pictures.small(pictures.pixels(drawn.pop("png").read_bytes())))
    return {**pictures.sums(drawn), "drawn with": pictures.environment()}


def _entry(verdict, build):
    """Return a line on the change in a figure and the commit that built it."""
    sidecar = build / f"results/figures/{verdict['figure']}.provenance.json"
    built = json.loads(sidecar.read_text(encoding="utf-8")) if sidecar.is_file() else {}
    commit = f" Built from {built['commit'][:10]} ({built['tree']} tree)." if built.get("commit") else ""
    first, *more = verdict["reasons"] or ["nothing that the check sees"]
    return f"- **{verdict['figure']}**: {first}{f', and {len(more)} more' * bool(more)}.{commit}"


def main(arguments=None) -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("figures", nargs="*", help="figures to accept; all that differ, if none is named")
    parser.add_argument("--reason", default="", help="why the reference changes; asked for, if not given")
    parser.add_argument("--pictures", action="store_true", help="keep the tables; take the pictures drawn of them now")
    parser.add_argument("--build", type=Path, default=Path(), help="folder in which results/ lies")
    parser.add_argument("--reference", type=Path, default=Path("figures"), help="folder of the reference set")
    given = parser.parse_args(arguments)
    check = given.build / "results/figure_check"
    try:
        verdicts = json.loads((check / "figure_check.json").read_text(encoding="utf-8"))
        found = changed(verdicts, given.figures)
        if not found:
            print("Nothing to accept: every figure agrees with its reference.")
            return 0
        print(*(line for verdict in found for line in summary(verdict, given.pictures)), sep="\n")
        print(f"Before, difference and after as pictures: {check / 'index.html'}")
        reason = given.reason if given.reason.strip() or not sys.stdin.isatty() else input("Reason: ")
        accept(found, given.build, given.reference, reason, datetime.date.today(), given.pictures)
    except (OSError, ValueError) as error:
        print(f"Not accepted. {error}", file=sys.stderr)
        return 1
    print(f"Accepted {len(found)} figure(s); recorded in {given.reference / 'CHANGES.md'}.")
    return 0


if __name__ == "__main__":
    sys.exit(main())
