"""All figures against their references -> the verdicts as JSON, JUnit XML and Markdown, and the page to read."""

import json
from concurrent.futures import ProcessPoolExecutor
from functools import partial
from pathlib import Path

from job import running
from vibroimpact.figures.kit.files import replacing
from vibroimpact_pipeline.checkout import root_of
from vibroimpact_pipeline.figure_check.compare import all_figures, check, tolerances
from vibroimpact_pipeline.figure_check.junit import junit
from vibroimpact_pipeline.figure_check.markdown import markdown
from vibroimpact_pipeline.figure_check.page import page, shown
from vibroimpact_pipeline.figure_check.verdicts import lines


def main(figures, columns: dict, reference, new, outputs: dict, processes: int = 1) -> None:
    """Compare, and write each of the outputs: page, verdicts, junit, summary."""
    limits = tolerances(columns)
    look = partial(look_at, reference=reference, new=new, limits=limits)
    with ProcessPoolExecutor(processes) as pool:
        seen = list(pool.map(look, all_figures(figures, reference)))
    found, addresses = [verdict for verdict, _ in seen], {verdict["figure"]: each for verdict, each in seen}
    print(*lines(found), sep="\n")
    written = {
        "page": page(found, addresses, limits),
        "verdicts": json.dumps(found, indent=1, allow_nan=False) + "\n",
        "junit": junit(found),
        "summary": markdown(found),
    }
    for name, text in written.items():
        with replacing(outputs[name]) as file:
            file.write_text(text, encoding="utf-8")


def look_at(figure, reference, new, limits: dict) -> tuple[dict, dict]:
    """The verdict on a figure and its pictures for the page, of files that are decoded once for both."""
    return check(figure, reference, new, limits), shown(figure, reference, new)


if "snakemake" in globals():
    with running(snakemake):
        params, outputs = snakemake.params, dict(snakemake.output.items())
        new = Path(outputs["page"]).parents[1] / "figures"
        main(params.figures, params.columns, root_of(snakemake) / "figures", new, outputs, snakemake.threads)
