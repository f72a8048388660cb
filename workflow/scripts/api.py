"""The docstrings of the library -> pages of the report."""

from job_log import logging_to
from vibroimpact_pipeline.checkout import root_of
from vibroimpact_pipeline.report.api import write

if "snakemake" in globals():
    with logging_to(snakemake.log[0]):
        write(snakemake.output[0], snakemake.params.modules, root_of(snakemake) / "report/api")
