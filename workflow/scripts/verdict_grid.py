"""Verdicts on every fixed point over a grid of forces and several epsilon -> CSV, a row per point and epsilon."""

from job import running
from vibroimpact.claims.verdict_grid import compute
from vibroimpact.figures.kit import tables
from vibroimpact.system import System


def main(parameters: dict, settings: dict, output) -> None:
    tables.write(compute(System(**parameters), **settings), output)


if "snakemake" in globals():
    with running(snakemake):
        main(snakemake.params.system, snakemake.params.settings, snakemake.output[0])
