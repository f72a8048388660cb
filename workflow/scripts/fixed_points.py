"""All fixed points of one case -> CSV: case, label, C1, C2, B1, B2, psi1, psi2, multiple, a row per point, by label."""

import pandas as pd

from job import running
from vibroimpact.figures.kit import tables
from vibroimpact.system import System
from vibroimpact.theory.fixed_points.labels import labels
from vibroimpact.theory.fixed_points.search import fixed_points

COLUMNS = ["case", "label", "C1", "C2", "B1", "B2", "psi1", "psi2", "multiple"]


def main(case: str, parameters: dict, output) -> None:
    system = System(**parameters)
    points = fixed_points(system)
    rows = [
        [case, label, *point.C, *point.B, *point.psi, point.multiple]
        for label, point in zip(labels(system, points), points, strict=True)
    ]
    tables.write(pd.DataFrame(rows, columns=COLUMNS).sort_values("label"), output)


if "snakemake" in globals():
    with running(snakemake):
        main(snakemake.wildcards.case, snakemake.params.system, snakemake.output[0])
