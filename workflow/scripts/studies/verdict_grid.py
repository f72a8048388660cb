"""Write the verdicts on every fixed point over a grid of forcing amplitudes and several epsilon as CSV."""

from vibroimpact_pipeline.jobs import running

from vibroimpact import tables
from vibroimpact.studies.claims.verdict_grid import compute
from vibroimpact.system import System

with running(snakemake) as out:
    tables.write(compute(System(**snakemake.params.system), **snakemake.params.settings), out.csv)
