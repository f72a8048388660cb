"""Work-precision measurements on all test problems -> work_precision.csv, and the chart."""

from vibroimpact_pipeline import provenance
from vibroimpact_pipeline.jobs import running

import pandas as pd

from vibroimpact import tables
from vibroimpact.accuracy.timing import versions
from vibroimpact.accuracy.work_precision import Problem, measure
from vibroimpact.figures import work_precision as figure
from vibroimpact.figures.plotting.style import save
from vibroimpact.integrators import TIMED
from vibroimpact.system import System

with running(snakemake) as out:
    rows = []
    for name, problem in snakemake.params.problems.items():
        start = Problem(name, System(**problem["system"]), tuple(problem["initial_state"]), problem["cycles"])
        rows += measure(start, TIMED, snakemake.params.seconds, snakemake.params.short)
    tables.write(pd.DataFrame(rows), out.csv)
    footer = "  ".join(f"{name} {version}" for name, version in versions().items())
    save(figure.draw(tables.read(out.csv), footer), vars(out))
    provenance.write(snakemake, out)
