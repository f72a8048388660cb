"""Join the tables of all cases into one table of fixed points and one table of orbits."""

from vibroimpact_pipeline.jobs import running

import pandas as pd

from vibroimpact import tables

with running(snakemake) as out:
    for paths, path in ((snakemake.input.points, out.csv), (snakemake.input.orbits, out.orbits)):
        tables.write(pd.concat([pd.read_csv(case) for case in paths], ignore_index=True), path)
