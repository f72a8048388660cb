"""Accept figures into the reference set: copy their tables, draw their pictures, and record the reason.

No other command writes to the reference set.
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
"""For each rule that checks figures, the folder of its reference set, relative to `figures/`."""
HEADING = "# Changes of the reference set\n\nWritten by `make accept`, newest first.\n"


def accept(verdicts: list[dict], build, reference, reason: str, date: datetime.date, pictures_only=False) -> None:
    """Copy tables from `build` to the reference set, draw their pictures, and record the reason for the change.

    Figures that are no longer built are removed from the reference set. If `pictures_only` is True, no table is
    copied, and the pictures are drawn from the present reference tables.

    Raises
    ------
    ValueError
        If the reason is empty, or if `pictures_only` is True and a figure is not yet in the reference set.
    """
    reason, reference, build = " ".join(reason.split()), Path(reference), Path(build)
    if not reason:
        raise ValueError('reason: empty, expected the reason for the change, for example REASON="longer axis"')
    built = [verdict["figure"] for verdict in verdicts if verdict["module"]]
    new = [figure for figure in built if not (reference / f"{figure}.png").exists()]
    if new and pictures_only:
        raise ValueError(f"{', '.join(new)}: no reference tables yet; accept without PICTURES=1")
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
    paths = [build / f"{verdict['stem']}.provenance.json" for verdict in verdicts]
    records = [json.loads(path.read_text(encoding="utf-8")) for path in paths if path.is_file()]
    commits = {f" Built from {one['commit'][:10]} ({one['tree']} tree)." for one in records if one.get("commit")}
    entry = f"- {date:%Y-%m-%d}: {reason} ({named}).{''.join(sorted(commits))}"
    changes.write_text(f"{HEADING}\n{entry}\n{earlier}", encoding="utf-8")


def main(arguments=None) -> int:
    """Accept the figures that the command line names; return the exit status."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("figures", nargs="*", help="figures to accept; default: all that did not pass")
    parser.add_argument("--reason", default="", help="why the reference set changes")
    parser.add_argument("--pictures", action="store_true", help="keep the reference tables and redraw their pictures")
    parser.add_argument("--build", type=Path, default=Path(), help="folder that contains results/")
    parser.add_argument("--reference", type=Path, default=Path("figures"), help="folder of the reference sets")
    given = parser.parse_args(arguments)
    try:
        checks = {given.reference / SETS[check]: given.build / f"results/{check}/figure_check.json" for check in SETS}
        sets = {folder: json.loads(path.read_text("utf-8")) for folder, path in checks.items() if path.is_file()}
        if not sets:
            raise ValueError("figures: none has been checked; run `make check-figures` or `make check-studies` first")
        known = {verdict["figure"]: verdict for verdicts in sets.values() for verdict in verdicts}
        if unknown := [figure for figure in given.figures if figure not in known]:
            raise ValueError(f"figures: unknown {', '.join(unknown)}; expected one or more of {', '.join(known)}")
        named = given.figures or [figure for figure, verdict in known.items() if verdict["status"] != PASSED]
        if not named:
            print("Nothing to accept: all figures match their reference.")
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
