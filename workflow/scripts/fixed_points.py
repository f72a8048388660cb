"""All fixed points of one case -> CSV: case, label, C1, C2, B1, B2, psi1, psi2; labels a, b, c, ... ascend in C1."""

from string import ascii_lowercase

import pandas as pd
from adapter import logging_to, write_csv

from vibroimpact.system import System
from vibroimpact.theory.fixed_points import fixed_points

COLUMNS = ["case", "label", "C1", "C2", "B1", "B2", "psi1", "psi2"]


def main(case: str, parameters: dict, output) -> None:
    points = fixed_points(System(**parameters))
    rows = [
        [case, label, *point.C, *point.B, *point.psi] for label, point in zip(ascii_lowercase, points, strict=False)
    ]
    write_csv(pd.DataFrame(rows, columns=COLUMNS), output)


if "snakemake" in globals():
    with logging_to(snakemake.log[0]):
        main(snakemake.wildcards.case, snakemake.params.system, snakemake.output[0])
