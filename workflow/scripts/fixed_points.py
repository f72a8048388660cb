"""All fixed points of one case -> CSV: case, label, C1, C2, B1, B2, psi1, psi2, multiple, a row per point, by label."""

from job import running
from vibroimpact.figures.kit import tables
from vibroimpact.figures.kit.fixed_point_table import fixed_point_table
from vibroimpact.system import System


def main(case: str, parameters: dict, output) -> None:
    tables.write(fixed_point_table(case, System(**parameters)), output)


if "snakemake" in globals():
    with running(snakemake):
        main(snakemake.wildcards.case, snakemake.params.system, snakemake.output[0])
