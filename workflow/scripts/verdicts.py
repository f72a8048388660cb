"""Fixed points of one case with the verdict of each criterion -> CSV: the rows of the case and columns for verdicts."""

from job import running
from vibroimpact.claims.verdict_table import CRITERIA, fixed_point_rows
from vibroimpact.figures.kit import tables
from vibroimpact.figures.kit.fixed_point_table import labelled_points
from vibroimpact.system import System


def main(case: str, parameters: dict, inputs: dict, output) -> None:
    points, orbits = tables.read(inputs["fixed_points"]), tables.read(inputs["orbits"])
    labelled = [(point.label, point) for point in labelled_points(points)]
    judged = fixed_point_rows(case, System(**parameters), labelled, orbits)
    verdicts = judged[["label", "admissible", "orbit", *CRITERIA]]
    tables.write(points.drop(columns="multiple").merge(verdicts, on="label", validate="one_to_one"), output)


if "snakemake" in globals():
    with running(snakemake):
        inputs = dict(snakemake.input.items())
        main(snakemake.wildcards.case, snakemake.params.system, inputs, snakemake.output[0])
