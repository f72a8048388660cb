"""The docstrings of the library -> pages of the report."""

import yaml

from vibroimpact_pipeline.code import ROOT
from vibroimpact_pipeline.jobs import running
from vibroimpact_pipeline.report.api import documented, write

with running(snakemake) as out:
    settings = yaml.safe_load((ROOT / "report/report.yaml").read_text(encoding="utf-8"))
    write(out.site, documented(settings["api"]["left_out"]), ROOT / "report/api")
