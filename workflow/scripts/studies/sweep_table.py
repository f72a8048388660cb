"""Join the tables of all tiles (parts of a sweep, one job each), and write the result as CSV and as NetCDF.

The NetCDF file has one dimension per axis of the sweep.
"""

import sys

from vibroimpact_pipeline.jobs import running

import pandas as pd

from vibroimpact import tables
from vibroimpact.frames import to_dataset
from vibroimpact.studies.sweeps.spec import POINT

with running(snakemake) as out:
    table = pd.concat(map(tables.read, snakemake.input), ignore_index=True).sort_values(POINT, ignore_index=True)
    if table[POINT].tolist() != list(range(snakemake.params.points)):
        sys.exit(f"tiles: {len(table)} rows, expected one for each of the {snakemake.params.points} points")
    tables.write(table, out.csv)
    to_dataset(table, map(tuple, snakemake.params.along)).to_netcdf(out.netcdf, engine="scipy")
