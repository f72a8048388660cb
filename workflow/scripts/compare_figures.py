"""All figures against their references -> the page to read, and the verdicts as JSON."""

import json
from pathlib import Path

from job_log import logging_to
from vibroimpact.figures.kit.files import replacing
from vibroimpact_pipeline.checkout import root_of
from vibroimpact_pipeline.figure_check.compare import check_all, tolerances
from vibroimpact_pipeline.figure_check.page import page
from vibroimpact_pipeline.figure_check.verdicts import lines


def main(figures, columns: dict, reference, new, html, verdicts) -> None:
    limits = tolerances(columns)
    found = check_all(figures, reference, new, limits)
    print(*lines(found), sep="\n")
    with replacing(verdicts) as partial:
        partial.write_text(json.dumps(found, indent=1, allow_nan=False) + "\n", encoding="utf-8")
    with replacing(html) as partial:
        partial.write_text(page(found, reference, new, limits), encoding="utf-8")


if "snakemake" in globals():
    with logging_to(snakemake.log[0]):
        params, outputs = snakemake.params, snakemake.output
        reference = root_of(snakemake) / "figures"
        new = Path(outputs.page).parents[1] / "figures"
        main(params.figures, params.columns, reference, new, outputs.page, outputs.verdicts)
