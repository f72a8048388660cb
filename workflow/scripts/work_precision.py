"""Work-precision measurements on all test problems -> work_precision.csv, and the chart."""

import pandas as pd

from job import running
from problems import problem_of
from vibroimpact.accuracy.timing import versions
from vibroimpact.accuracy.work_precision import measure
from vibroimpact.figures.kit import tables
from vibroimpact.figures.kit.style import save
from vibroimpact.figures.work_precision import draw
from vibroimpact.rivals import METHODS
from vibroimpact_pipeline.provenance.record import recorded


def main(problems: dict, seconds: float, short: bool, outputs: dict, provenance: dict) -> None:
    rows = []
    for name, problem in problems.items():
        rows += measure(problem_of(name, problem["system"], problem["settings"]), METHODS, seconds, short)
    table = pd.DataFrame(rows)
    tables.write(table, outputs["csv"])
    footer = "  ".join(f"{name} {version}" for name, version in versions().items())
    save(draw(table, footer), outputs, provenance)


if "snakemake" in globals():
    with running(snakemake), recorded(snakemake) as (provenance, outputs):
        params = snakemake.params
        main(params.problems, params.seconds, params.short, outputs, provenance)
