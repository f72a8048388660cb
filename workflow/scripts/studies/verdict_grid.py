"""Write a CSV table of the verdicts on fixed points, for a grid of forcing amplitudes and several values of epsilon."""

from vibroimpact_pipeline.jobs import running

from vibroimpact import tables
from vibroimpact.studies.claims.verdict_grid import compute
from vibroimpact.system import System

with running(snakemake) as out:
    tables.write(compute(System(**snakemake.params.system), **snakemake.params.settings), out.csv)
