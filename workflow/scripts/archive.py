"""The checkout and all results of the default build -> one archive."""

import sys
from pathlib import Path

from vibroimpact_pipeline import archive
from vibroimpact_pipeline.code import FIGURES, ROOT
from vibroimpact_pipeline.jobs import running
from vibroimpact_pipeline.results import recorded_files
from vibroimpact_pipeline.specs import specs

with running(snakemake) as out:
    titles = {figure: spec["title"] for figure, spec in specs(ROOT / FIGURES).items()}
    try:
        archive.write(Path.cwd(), [*recorded_files(Path("results"))], titles, out.archive)
    except ValueError as error:
        sys.exit(str(error))
