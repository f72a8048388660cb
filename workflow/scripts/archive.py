"""Pack the checkout, and the results of the default build and of the studies, into one archive."""

import sys

from vibroimpact_pipeline import archive
from vibroimpact_pipeline.code import ROOT
from vibroimpact_pipeline.jobs import running
from vibroimpact_pipeline.result_records import checked_digests
from vibroimpact_pipeline.specs import specs

with running(snakemake) as out:
    titles = {figure: spec["title"] for figure, spec in specs().items()}
    try:
        behind = archive.results_behind(snakemake.input)
        checked_digests(behind)
        archive.write(ROOT, behind, titles, out.archive)
    except ValueError as error:
        sys.exit(f"archive: {error}")
