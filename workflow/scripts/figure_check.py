"""Say what the figure check has found; exit status 1 where a figure has failed."""

import json
import sys
from pathlib import Path

from job import running
from vibroimpact_pipeline.figure_check.check import FAILED, NOT_COMPARABLE, command, has_failed, lines


def main(verdicts, page, strict: bool = False) -> int:
    """Print a line for each figure that has not passed, and what to do; give the exit status.

    strict: whether it is a failure, too, that pixels could not be compared.
    """
    found = json.loads(Path(verdicts).read_text(encoding="utf-8"))
    print(*lines(found), f"Reference, new and difference of every figure: {page}", sep="\n")
    if failed := [verdict["figure"] for verdict in found if verdict["status"] == FAILED]:
        print(f"To take a change on purpose into the reference set: {command(failed)}")
    if others := [verdict["figure"] for verdict in found if verdict["status"] == NOT_COMPARABLE]:
        print("Pictures are comparable with the versions that drew the reference, those of environment.lock.")
        print(f"To keep the tables and draw these anew: {command(others)} PICTURES=1")
    sys.stdout.flush()
    return int(has_failed(found, strict))


if "snakemake" in globals():
    with running(snakemake):
        page = Path(snakemake.input[0]).with_name("index.html")
        status = main(snakemake.input[0], page, snakemake.params.get("strict", False))
    sys.exit(status)
