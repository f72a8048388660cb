"""Compare all figures with the reference set, and exit with status 1 if a figure fails."""

import json
import os
import sys
from pathlib import Path

from vibroimpact_pipeline.code import ROOT
from vibroimpact_pipeline.figure_check.check import PASSED, check_all, has_failed, lines
from vibroimpact_pipeline.figure_check.page import page
from vibroimpact_pipeline.jobs import running
from vibroimpact_pipeline.result_records import replacing
from vibroimpact_pipeline.specs import spec_of, specs

FOLDER = Path(snakemake.params.page)
REFERENCE = ROOT / snakemake.params.reference
TERMINAL = os.fdopen(os.dup(sys.stdout.fileno()), "w", encoding="utf-8")

with running(snakemake):
    figures = {figure: spec_of(figure, scene, specs()) for figure, scene in snakemake.params.figures.items()}
    found = check_all(figures, REFERENCE, Path("."), snakemake.threads)
    texts = {
        "index.html": page(found, REFERENCE, Path(".")),
        "figure_check.json": json.dumps(found, indent=1, allow_nan=False) + "\n",
        "summary.md": "### Figure check\n\n" + "".join(f"- {line}\n" for line in lines(found)),
    }
    for name, text in texts.items():
        with replacing(FOLDER / name) as partial:
            partial.write_text(text, encoding="utf-8")
    report = [*lines(found), f"Page with reference, new picture and difference of every figure: {FOLDER}/index.html"]
    if others := " ".join(verdict["figure"] for verdict in found if verdict["status"] != PASSED):
        report += [f'To accept intended changes: make accept REASON="why" FIGURES="{others}"']
        report += ["PICTURES=1 keeps the reference tables and redraws their pictures."]
    for stream in (sys.stdout, TERMINAL):  # print to the log and to the terminal
        print(*report, sep="\n", file=stream, flush=True)
    if has_failed(found, strict=bool(os.getenv("STRICT"))):
        sys.exit("Some figures differ from the reference set.")
