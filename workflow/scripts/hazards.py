"""Verdicts on every method in every hazard -> hazards.csv, and the table as a picture."""

import pandas as pd

from job import running
from vibroimpact.accuracy.hazards import hazards, judge
from vibroimpact.figures.hazards import draw
from vibroimpact.figures.kit import tables
from vibroimpact.figures.kit.style import save
from vibroimpact.rivals import METHODS
from vibroimpact_pipeline.provenance.record import recorded


def main(all_of_them: bool, outputs: dict, provenance: dict) -> None:
    chosen = [hazard for hazard in hazards() if all_of_them or hazard.quick]
    table = pd.DataFrame([row for hazard in chosen for row in judge(hazard, METHODS)])
    tables.write(table, outputs["csv"])
    save(draw(table), outputs, provenance)


if "snakemake" in globals():
    with running(snakemake), recorded(snakemake) as (provenance, outputs):
        main(snakemake.params.all_of_them, outputs, provenance)
