"""Accept the new figures as the reference set: show what changes, ask for a reason, record both.

Nothing else writes into the reference set.
"""

import argparse
import datetime
import json
import sys
from pathlib import Path

from vibroimpact.figures.kit.files import replacing

from vibroimpact_pipeline.figure_check import origins, pictures
from vibroimpact_pipeline.figure_check.compare import files_of, shown
from vibroimpact_pipeline.figure_check.verdicts import PASSED

HEADING = "# Changes of the reference set\n\nWritten by `make accept`, newest first.\n"
SHOWN = 8
"""Reasons shown per figure; the page has more, figure_check.json has all."""


def changed(verdicts: list[dict], figures=()) -> list[dict]:
    """Verdicts on the named figures, or on all that did not pass.

    Raises:
        ValueError: a name that no verdict has.
    """
    known = {verdict["figure"]: verdict for verdict in verdicts}
    unknown = [figure for figure in figures if figure not in known]
    if unknown:
        raise ValueError(f"figures: unknown {', '.join(unknown)}; there are {', '.join(known)}")
    return [v for v in verdicts if (v["figure"] in figures if figures else v["status"] != PASSED)]


def summary(verdict: dict) -> list[str]:
    """What changes in one figure: numbers before and after, their distance, and what else is found."""
    said = [f"{verdict['figure']}: {verdict['status']}"]
    for column in verdict["tables"]:
        if column["distance"] != 0:
            before, after, distance = (_said(column[name]) for name in ("reference", "new", "distance"))
            said.append(
                f"  {column['table']}, {column['column']}: before {before}, after {after}, "
                f"difference {distance} {column['unit']} ({column['where']})"
            )
    reasons = verdict["reasons"]
    said += [f"  {reason}" for reason in reasons[:SHOWN]]
    return said + [f"  and {len(reasons) - SHOWN} more"] * (len(reasons) > SHOWN)


def moved(verdict: dict) -> list[str]:
    """What has changed in a figure besides the pixels of its picture."""
    compared = verdict["artists"] and verdict["picture"]
    return [reason for reason in verdict["reasons"] if not (compared and reason.startswith("picture: "))]


def accept(verdicts: list[dict], new, reference, reason: str, date: datetime.date, pictures_only: bool = False) -> None:
    """Copy the files of the given figures into the reference set, and write down why.

    A figure that is no longer built leaves the set.

    Args:
        verdicts: on the figures, as the figure check gives them.
        new, reference: folders.
        reason: one line.
        date: of the entry.
        pictures_only: keep numbers and artists as they are; take the pictures, and the versions that drew them.

    Raises:
        ValueError: the reason is empty; or pictures alone are wanted, and something else has moved. Nothing is written.
    """
    reason = " ".join(reason.split())
    if not reason:
        raise ValueError("reason: empty; say why the reference set changes")
    if pictures_only and (others := [f"{v['figure']} ({moved(v)[0]})" for v in verdicts if moved(v)]):
        raise ValueError(f"pictures alone: more has moved in {'; '.join(others)}; to accept that, leave out PICTURES=1")
    entries = [_entry(verdict, new) for verdict in verdicts]
    for verdict in verdicts:
        (_take_picture if pictures_only else _take)(verdict["figure"], Path(new), Path(reference))
    changes = Path(reference) / "CHANGES.md"
    earlier = changes.read_text(encoding="utf-8").removeprefix(HEADING) if changes.exists() else ""
    with replacing(changes) as partial:
        text = f"{HEADING}\n## {date:%Y-%m-%d}: {reason}\n\n" + "\n".join(entries) + "\n" + earlier
        partial.write_text(text, encoding="utf-8")


def _take(figure, new, reference):
    fresh = {name: _kept(path) for name, path in files_of(figure, new).items() if path.is_file()}
    for name, content in fresh.items():
        with replacing(reference / name) as partial:
            partial.write_bytes(content)
    for name, path in files_of(figure, reference).items():
        if name not in fresh:
            path.unlink(missing_ok=True)
    origins.take(figure, new, reference)


def _take_picture(figure, new, reference):
    picture = _kept(new / f"{figure}.png")
    name = f"{figure}.artists.json"
    drawn, kept = (json.loads((folder / name).read_text(encoding="utf-8")) for folder in (new, reference))
    content = json.dumps(kept | {"drawn with": drawn["drawn with"]}, indent=1, ensure_ascii=False) + "\n"
    with replacing(reference / f"{figure}.png") as partial:
        partial.write_bytes(picture)
    with replacing(reference / name) as partial:
        partial.write_text(content, encoding="utf-8")


def _kept(path) -> bytes:
    """What is kept of a file: of a picture its colours without loss, in fewer bytes."""
    return pictures.png(pictures.colours(path)) if path.suffix == ".png" else path.read_bytes()


def _entry(verdict, new):
    """A line on what changes in a figure and what built it."""
    sidecar = Path(new) / f"{verdict['figure']}.provenance.json"
    built = json.loads(sidecar.read_text(encoding="utf-8")) if sidecar.is_file() else {}
    commit = f" Built from {built['commit'][:10]} ({built['tree']} tree)." if built.get("commit") else ""
    first, *more = verdict["reasons"] or ["nothing that the check sees"]
    return f"- **{verdict['figure']}**: {first}" + (f", and {len(more)} more" if more else "") + f".{commit}"


def _said(value):
    return "nothing finite" if value is None else shown(value)


def main(arguments=None) -> int:
    parser = argparse.ArgumentParser(
        prog="python -m vibroimpact_pipeline.figure_check.accept", description=__doc__.splitlines()[0]
    )
    parser.add_argument("figures", nargs="*", help="figures to accept; all that differ, if none is named")
    parser.add_argument("--reason", default="", help="why the reference changes; asked for, if not given")
    parser.add_argument(
        "--pictures", action="store_true", help="take pictures alone, and refuse if a number or an artist has moved"
    )
    parser.add_argument("--check", type=Path, default=Path("results/figure_check"), help="folder of the figure check")
    parser.add_argument("--new", type=Path, default=Path("results/figures"), help="folder of the new figures")
    parser.add_argument("--reference", type=Path, default=Path("figures"), help="folder of the reference set")
    given = parser.parse_args(arguments)
    try:
        verdicts = json.loads((given.check / "figure_check.json").read_text(encoding="utf-8"))
        found = changed(verdicts, given.figures)
        if not found:
            print("Nothing to accept: every figure agrees with its reference.")
            return 0
        print(*(line for verdict in found for line in summary(verdict)), sep="\n")
        print(f"Before, difference and after as pictures: {given.check / 'index.html'}")
        reason = given.reason if given.reason.strip() or not sys.stdin.isatty() else input("Reason: ")
        accept(found, given.new, given.reference, reason, datetime.date.today(), given.pictures)
    except (OSError, ValueError) as error:
        print(f"Not accepted. {error}", file=sys.stderr)
        return 1
    print(f"Accepted {len(found)} figure(s); recorded in {given.reference / 'CHANGES.md'}.")
    return 0


if __name__ == "__main__":
    sys.exit(main())
