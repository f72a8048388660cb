"""Say what the figure check has found; exit status 1 where a figure has failed."""

import json
import sys
from pathlib import Path

from job import running
from vibroimpact_pipeline.figure_check.compare import has_failed, lines


def main(verdicts, page) -> int:
    found = json.loads(Path(verdicts).read_text(encoding="utf-8"))
    print(*lines(found), f"Reference, new and difference of every figure: {page}", sep="\n", flush=True)
    return int(has_failed(found))


if "snakemake" in globals():
    with running(snakemake):
        status = main(snakemake.input[0], Path(snakemake.input[0]).with_name("index.html"))
    sys.exit(status)
