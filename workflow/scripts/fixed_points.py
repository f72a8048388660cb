"""All fixed points of one case -> CSV, a row per point, by label."""

import pandas as pd

from vibroimpact.figures.kit import tables
from vibroimpact.system import System
from vibroimpact.theory.fixed_points.labels import labels
from vibroimpact.theory.fixed_points.search import fixed_points
from vibroimpact_pipeline.jobs import running

COLUMNS = ["case", "label", "C1", "C2", "B1", "B2", "psi1", "psi2", "multiple"]

with running(snakemake) as out:
    system = System(**snakemake.params.system)
    points = fixed_points(system)
    rows = [
        [snakemake.wildcards.case, label, *point.C, *point.B, *point.psi, point.multiple]
        for label, point in zip(labels(system, points), points, strict=True)
    ]
    tables.write(pd.DataFrame(rows, columns=COLUMNS).sort_values("label"), out.csv)
