"""Verdicts on every fixed point over a grid of forces and several epsilon -> CSV, a row per point and epsilon."""

from vibroimpact_pipeline.jobs import running

from vibroimpact import tables
from vibroimpact.studies.claims.verdict_grid import compute
from vibroimpact.system import System

with running(snakemake) as out:
    tables.write(compute(System(**snakemake.params.system), **snakemake.params.settings), out.csv)
