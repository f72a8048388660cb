"""Fixed points of one case with the verdict of each criterion -> CSV: the rows of the case and columns for verdicts."""

import pandas as pd

from job_log import logging_to
from vibroimpact.claims.verdict_table import CRITERIA, fixed_point_rows
from vibroimpact.figures.kit import tables
from vibroimpact.system import System
from vibroimpact.theory.fixed_points.labels import labels
from vibroimpact.theory.fixed_points.search import fixed_points


def main(case: str, parameters: dict, inputs: dict, output) -> None:
    """Judge the points as computed, which know how well they are determined; places are those of the table."""
    points, orbits = pd.read_csv(inputs["fixed_points"]), pd.read_csv(inputs["orbits"])
    system = System(**parameters)
    listed = fixed_points(system)
    judged = fixed_point_rows(case, system, zip(labels(system, listed), listed, strict=True), orbits)
    verdicts = judged[["label", "admissible", "orbit", *CRITERIA]]
    tables.write(points.merge(verdicts, on="label", validate="one_to_one"), output)


if "snakemake" in globals():
    with logging_to(snakemake.log[0]):
        inputs = dict(snakemake.input.items())
        main(snakemake.wildcards.case, snakemake.params.system, inputs, snakemake.output[0])
