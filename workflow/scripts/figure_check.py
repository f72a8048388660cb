"""All figures against the reference set -> page, verdicts, summary; exit status 1 if a figure fails."""

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

BUILD = Path(snakemake.input[0].rpartition("results/")[0])  # below the prefix of a module
FOLDER = BUILD / snakemake.params.page
REFERENCE = ROOT / snakemake.params.reference
TERMINAL = os.fdopen(os.dup(sys.stdout.fileno()), "w", encoding="utf-8")

with running(snakemake):
    figures = {figure: spec_of(figure, scene, specs()) for figure, scene in snakemake.params.figures.items()}
    found = check_all(figures, REFERENCE, BUILD, snakemake.threads)
    texts = {
        "index.html": page(found, REFERENCE, BUILD),
        "figure_check.json": json.dumps(found, indent=1, allow_nan=False) + "\n",
        "summary.md": "### Figure check\n\n" + "".join(f"- {line}\n" for line in lines(found)),
    }
    for name, text in texts.items():
        with replacing(FOLDER / name) as partial:
            partial.write_text(text, encoding="utf-8")
    report = [*lines(found), f"Reference, new and difference of every figure: {FOLDER}/index.html"]
    if others := " ".join(verdict["figure"] for verdict in found if verdict["status"] != PASSED):
        report += [f'To accept a change on purpose: make accept REASON="why" FIGURES="{others}"']
        report += ["With PICTURES=1 the tables of the reference stay, and their pictures are drawn anew."]
    for stream in (sys.stdout, TERMINAL):  # the log, and who has asked
        print(*report, sep="\n", file=stream, flush=True)
    if has_failed(found, snakemake.params.strict):
        sys.exit("Some figures are not those of the reference set.")
