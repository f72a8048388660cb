"""All fixed points of one case -> CSV, a row per point, by label."""

from vibroimpact_pipeline.jobs import running

from vibroimpact import tables
from vibroimpact.system import System
from vibroimpact.theory.fixed_points.table import fixed_point_table

with running(snakemake) as out:
    tables.write(fixed_point_table(snakemake.wildcards.case, System(**snakemake.params.system)), out.csv)
