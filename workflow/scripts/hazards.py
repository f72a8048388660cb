"""Verdicts on every method in every stress test -> hazards.csv, and the table as a picture."""

import pandas as pd

from vibroimpact.accuracy.hazards import hazards, judge
from vibroimpact.figures import hazards as figure
from vibroimpact.figures.kit.style import write_and_draw
from vibroimpact.integrators import METHODS
from vibroimpact_pipeline import provenance
from vibroimpact_pipeline.jobs import running

with running(snakemake) as out:
    chosen = [hazard for hazard in hazards() if snakemake.params.full or hazard.quick]
    table = pd.DataFrame([row for hazard in chosen for row in judge(hazard, METHODS)])
    made = provenance.record(snakemake)
    write_and_draw(figure, table, vars(out), made)
    provenance.write(out.provenance, made)
