"""Work-precision chart and stress tests -> CSV, a row per method."""

from vibroimpact_pipeline.jobs import running

from vibroimpact import tables
from vibroimpact.accuracy.comparison import compare

with running(snakemake) as out:
    tables.write(compare(tables.read(snakemake.input.work_precision), tables.read(snakemake.input.hazards)), out.csv)
