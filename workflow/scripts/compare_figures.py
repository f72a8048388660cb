"""All figures against their references -> the verdicts as JSON, JUnit XML and Markdown, and the page to read."""

import json
from pathlib import Path

from job import running
from vibroimpact.figures.kit.files import replacing
from vibroimpact_pipeline.checkout import root_of
from vibroimpact_pipeline.figure_check.compare import check_all, tolerances
from vibroimpact_pipeline.figure_check.junit import junit
from vibroimpact_pipeline.figure_check.markdown import markdown
from vibroimpact_pipeline.figure_check.page import page
from vibroimpact_pipeline.figure_check.verdicts import lines


def main(figures, columns: dict, reference, new, outputs: dict, processes: int = 1) -> None:
    """Compare, and write each of the outputs: page, verdicts, junit, summary."""
    limits = tolerances(columns)
    found = check_all(figures, reference, new, limits, processes)
    print(*lines(found), sep="\n")
    written = {
        "page": page(found, reference, new, limits),
        "verdicts": json.dumps(found, indent=1, allow_nan=False) + "\n",
        "junit": junit(found),
        "summary": markdown(found),
    }
    for name, text in written.items():
        with replacing(outputs[name]) as partial:
            partial.write_text(text, encoding="utf-8")


if "snakemake" in globals():
    with running(snakemake):
        params, outputs = snakemake.params, dict(snakemake.output.items())
        new = Path(outputs["page"]).parents[1] / "figures"
        main(params.figures, params.columns, root_of(snakemake) / "figures", new, outputs, snakemake.threads)
