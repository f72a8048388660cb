"""Fixed points of one case with the verdict of each criterion -> CSV: the rows of the case and columns for verdicts."""

from vibroimpact_pipeline.jobs import running

from vibroimpact import tables
from vibroimpact.accuracy.verdict_table import CRITERIA, FORMER, fixed_point_rows
from vibroimpact.system import System
from vibroimpact.theory.fixed_points.table import labelled_points

with running(snakemake) as out:
    points, orbits = tables.read(snakemake.input.fixed_points), tables.read(snakemake.input.orbits)
    labelled = [(point.label, point) for point in labelled_points(points)]
    judged = fixed_point_rows(snakemake.wildcards.case, System(**snakemake.params.system), labelled, orbits)
    verdicts = judged[["label", "admissible", "orbit", *CRITERIA, *FORMER]]
    tables.write(points.drop(columns="multiple").merge(verdicts, on="label", validate="one_to_one"), out.csv)
