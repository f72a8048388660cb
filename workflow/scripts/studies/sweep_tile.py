"""Compute one tile of a sweep (a subset of the grid points), and write a CSV table with one row per point."""

from vibroimpact_pipeline.jobs import running

import pandas as pd

from vibroimpact import tables
from vibroimpact.exact.engine.all_cores import at_most
from vibroimpact.studies.sweeps.rows import columns, rows
from vibroimpact.studies.sweeps.spec import parsed

with running(snakemake) as out, at_most(snakemake.threads):
    grid, spec = parsed(snakemake.params.request)
    number, tiles = map(int, snakemake.wildcards.scatteritem.split("-of-"))
    tables.write(pd.DataFrame(rows(grid, spec, grid.tile(number, tiles)), columns=columns(grid, spec)), out.csv)
