"""Do two builds give the same bytes? Compared is every table and picture that contains no timing."""

import argparse
import re
import sys
from pathlib import Path

from vibroimpact_pipeline.integrity.checksums import digest_of

KINDS = ".csv", ".parquet", ".png", ".svg", ".pdf"
TIME = re.compile(r"seconds|_s$")
"""Columns that hold run times: such a table, and the pictures beside it of the same name, are left out."""
PARTS = "tiles"
"""What holds the parts of sweeps, of which run times decide how many there are: the whole tables are compared."""


def digests(folder) -> dict[str, str]:
    """Digest of every file below a folder that contains no timing, by its path there."""
    folder = Path(folder)
    files = sorted(path for path in folder.rglob("*") if path.suffix in KINDS and path.is_file())
    timed = {path.with_suffix("") for path in files if path.suffix == ".csv" and has_time(path)}
    kept = [path for path in files if path.with_suffix("") not in timed and path.parent.name != PARTS]
    return {str(path.relative_to(folder)): digest_of(path) for path in kept}


def has_time(table) -> bool:
    """Whether a table has a column of run times."""
    with open(table, encoding="utf-8") as file:
        return any(TIME.search(column.strip()) for column in file.readline().split(","))


def differences(first, second) -> list[str]:
    """Files that only one of two folders has, or that differ; one line each."""
    old, new = digests(first), digests(second)
    alone = [f"{name}: in one build only" for name in sorted(old.keys() ^ new.keys())]
    return alone + [f"{name}: other bytes" for name in sorted(old.keys() & new.keys()) if old[name] != new[name]]


def main(arguments=None) -> int:
    parser = argparse.ArgumentParser(
        prog="python -m vibroimpact_pipeline.same_bytes", description=__doc__.splitlines()[0]
    )
    parser.add_argument("first", type=Path, help="results of a build")
    parser.add_argument("second", type=Path, help="results of another")
    given = parser.parse_args(arguments)
    found, files = differences(given.first, given.second), len(digests(given.first))
    print(*found, f"{files} files without timing; {len(found)} differ.", sep="\n")
    return int(bool(found) or not files)


if __name__ == "__main__":
    sys.exit(main())
