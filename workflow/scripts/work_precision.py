"""Work-precision measurements of all scenes -> work_precision.csv, and the chart."""

import pandas as pd

from job_log import logging_to
from scenes import scene_of
from vibroimpact.accuracy.timing import versions
from vibroimpact.accuracy.work_precision import measure
from vibroimpact.figures.companions.work_precision import draw
from vibroimpact.figures.kit import tables
from vibroimpact.figures.kit.style import save
from vibroimpact.rivals import METHODS
from vibroimpact_pipeline.provenance.record import recorded


def main(scenes: dict, seconds: float, short: bool, outputs: dict, provenance: dict) -> None:
    rows = []
    for name, scene in scenes.items():
        rows += measure(scene_of(name, scene["system"], scene["settings"]), METHODS, seconds, short)
    table = pd.DataFrame(rows)
    tables.write(table, outputs["csv"])
    footer = "  ".join(f"{name} {version}" for name, version in versions().items())
    save(draw(table, footer), outputs, provenance)


if "snakemake" in globals():
    with logging_to(snakemake.log[0]), recorded(snakemake) as (provenance, outputs):
        params = snakemake.params
        main(params.scenes, params.seconds, params.short, outputs, provenance)
