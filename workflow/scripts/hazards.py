"""Verdicts on every method in every stress test -> hazards.csv, and the table as a picture."""

from vibroimpact_pipeline import provenance
from vibroimpact_pipeline.jobs import running

import pandas as pd

from vibroimpact.accuracy.stress_tests import FORMER, judge, stress_tests
from vibroimpact.figures import hazards as figure
from vibroimpact.figures.plotting.style import write_and_draw
from vibroimpact.frames import with_former_names
from vibroimpact.integrators import METHODS

with running(snakemake) as out:
    chosen = [test for test in stress_tests() if snakemake.params.full or test.quick]
    table = with_former_names(pd.DataFrame([row for test in chosen for row in judge(test, METHODS)]), FORMER)
    write_and_draw(figure, table, vars(out))
    provenance.write(snakemake, out)
