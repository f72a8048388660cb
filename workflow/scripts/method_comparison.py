"""For each method, summarise the work-precision chart and the stress tests; list the recommended methods."""

from vibroimpact_pipeline.jobs import running

from vibroimpact import tables
from vibroimpact.accuracy.comparison import choices, methods_table

with running(snakemake) as out:
    work_precision = tables.read(snakemake.input.work_precision)
    compared = methods_table(work_precision, tables.read(snakemake.input.stress_tests))
    tables.write(compared, out.csv)
    tables.write(choices(work_precision, compared), out.choices)
