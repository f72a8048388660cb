"""Accept figures as the reference set: copy their tables, draw their pictures, and record the reason.

Nothing else writes into the reference set.
"""

import argparse
import datetime
import json
import shutil
import sys
from pathlib import Path
from tempfile import TemporaryDirectory

from vibroimpact.figures.plotting.versions import drawing_versions
from vibroimpact.tables import read
from vibroimpact_pipeline.figure_check import pictures
from vibroimpact_pipeline.figure_check.check import PASSED, SUMS, line, reference_sums

SETS = {"figure_check": "", "study_check": "studies"}
"""Folders of reference sets, below that of the chapter's figures, by the check of each."""
HEADING = "# Changes of the reference set\n\nWritten by `make accept`, newest first.\n"


def accept(verdicts: list[dict], build, reference, reason: str, date: datetime.date, pictures_only=False) -> None:
    """Copy the tables of figures into the reference set, draw their pictures, and record the reason.

    A figure that is no longer built leaves the set.

    Args:
        verdicts: on these figures. build: folder in which results/ lies. reference: folder of the set.
        reason: one line. date: of the entry.
        pictures_only: keep the tables, and take the pictures that are drawn of them now.

    Raises:
        ValueError: the reason is empty, or a figure that has no reference is to keep its tables. Nothing is written.
    """
    reason, reference, build = " ".join(reason.split()), Path(reference), Path(build)
    if not reason:
        raise ValueError('reason: empty; say why the reference set changes, REASON="a longer axis"')
    new = [verdict["figure"] for verdict in verdicts if _is_new(verdict, reference)]
    if new and pictures_only:
        raise ValueError(f"{', '.join(new)}: no reference, whose tables could be kept; accept it without PICTURES=1")
    sums = reference_sums(reference)
    for verdict in verdicts:
        figure, files = verdict["figure"], verdict["files"]
        sums.pop(figure, None)
        if not verdict["module"]:
            for path in reference.glob(f"{figure}.*"):
                path.unlink()
            continue
        for file, path in () if pictures_only else files.values():
            shutil.copyfile(build / path, reference / file)
        with TemporaryDirectory() as folder:
            tables = {name: read(reference / file) for name, (file, _) in files.items()}
            drawn = pictures.draw(verdict["module"], tables, figure, folder)
            (reference / f"{figure}.png").write_bytes(pictures.small(drawn.pop("png").read_bytes()))
            sums[figure] = {**pictures.sums(drawn), "drawn with": drawing_versions()}
    (reference / SUMS).write_text(json.dumps(dict(sorted(sums.items())), indent=1) + "\n", encoding="utf-8")
    changes = reference / "CHANGES.md"
    earlier = changes.read_text(encoding="utf-8").removeprefix(f"{HEADING}\n") if changes.exists() else ""
    named = ", ".join(f"new {name}" if name in new else name for name in (one["figure"] for one in verdicts))
    built = "".join(sorted({_built_from(one, build) for one in verdicts}))
    changes.write_text(f"{HEADING}\n- {date:%Y-%m-%d}: {reason} ({named}).{built}\n{earlier}", encoding="utf-8")


def _is_new(verdict, reference):
    return verdict["module"] and not (reference / f"{verdict['figure']}.png").exists()


def _built_from(verdict, build):
    path = build / f"{verdict['stem']}.provenance.json"
    record = json.loads(path.read_text(encoding="utf-8")) if path.is_file() else {}
    return f" Built from {record['commit'][:10]} ({record['tree']} tree)." if record.get("commit") else ""


def main(arguments=None) -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("figures", nargs="*", help="figures to accept; all that differ, if none is named")
    parser.add_argument("--reason", default="", help="why the reference changes")
    parser.add_argument("--pictures", action="store_true", help="keep the tables; take the pictures drawn of them now")
    parser.add_argument("--build", type=Path, default=Path(), help="folder in which results/ lies")
    parser.add_argument("--reference", type=Path, default=Path("figures"), help="folder of the reference sets")
    given = parser.parse_args(arguments)
    try:
        checks = {given.reference / SETS[check]: given.build / f"results/{check}/figure_check.json" for check in SETS}
        sets = {folder: json.loads(path.read_text("utf-8")) for folder, path in checks.items() if path.is_file()}
        if not sets:
            raise ValueError("No figure has been checked: run `make check-figures` or `make check-studies` first.")
        known = {verdict["figure"]: verdict for verdicts in sets.values() for verdict in verdicts}
        if unknown := [figure for figure in given.figures if figure not in known]:
            raise ValueError(f"figures: unknown {', '.join(unknown)}; there are {', '.join(known)}")
        named = given.figures or [figure for figure, verdict in known.items() if verdict["status"] != PASSED]
        if not named:
            print("Nothing to accept: every figure agrees with its reference.")
            return 0
        for folder, verdicts in sets.items():
            if found := [verdict for verdict in verdicts if verdict["figure"] in named]:
                accept(found, given.build, folder, given.reason, datetime.date.today(), given.pictures)
    except (OSError, ValueError) as error:
        print(f"Not accepted. {error}", file=sys.stderr)
        return 1
    print(*(line(known[figure]) for figure in named), f"Accepted {len(named)} figure(s); see CHANGES.md.", sep="\n")
    return 0


if __name__ == "__main__":
    sys.exit(main())
