"""The docstrings of the library -> pages of the report."""

from job import running
from vibroimpact_pipeline.checkout import root_of
from vibroimpact_pipeline.report.api import write

if "snakemake" in globals():
    with running(snakemake):
        write(snakemake.output[0], snakemake.params.modules, root_of(snakemake) / "report/api")
