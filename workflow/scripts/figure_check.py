"""All figures against the reference set -> page, verdicts, summary; exit status 1 if a figure fails."""

import json
import os
import sys
from pathlib import Path

from vibroimpact_pipeline.code import ROOT
from vibroimpact_pipeline.figure_check.check import FAILED, NOT_COMPARABLE, check_all, command, has_failed, lines
from vibroimpact_pipeline.figure_check.page import page
from vibroimpact_pipeline.jobs import running
from vibroimpact_pipeline.results import replacing
from vibroimpact_pipeline.specs import made, specs

BUILD = Path(snakemake.input[0].rpartition("results/")[0])  # below the prefix of a module
FOLDER = BUILD / "results/figure_check"
TERMINAL = os.fdopen(os.dup(sys.stdout.fileno()), "w", encoding="utf-8")

with running(snakemake):
    found = check_all(made(snakemake.params.config, specs()), ROOT / "figures", BUILD, snakemake.threads)
    texts = {
        "index.html": page(found, ROOT / "figures", BUILD),
        "figure_check.json": json.dumps(found, indent=1, allow_nan=False) + "\n",
        "summary.md": "### Figure check\n\n" + "".join(f"- {line}\n" for line in lines(found)),
    }
    for name, text in texts.items():
        with replacing(FOLDER / name) as partial:
            partial.write_text(text, encoding="utf-8")
    said = [*lines(found), f"Reference, new and difference of every figure: {FOLDER}/index.html"]
    if failed := [verdict for verdict in found if verdict["status"] == FAILED]:
        drawing = all(reason.startswith(("picture:", "pdf:", "svg:")) for one in failed for reason in one["reasons"])
        accept = command(one["figure"] for one in failed) + " PICTURES=1" * drawing
        said += [f"To take a change on purpose into the reference set: {accept}"]
    if others := [verdict["figure"] for verdict in found if verdict["status"] == NOT_COMPARABLE]:
        said += ["Pictures are comparable with the versions that drew the reference, those of environment.lock."]
        said += [f"To keep the tables and draw these anew: {command(others)} PICTURES=1"]
    for stream in (sys.stdout, TERMINAL):  # the log, and who has asked
        print(*said, sep="\n", file=stream, flush=True)
sys.exit(int(has_failed(found, snakemake.params.strict)))
