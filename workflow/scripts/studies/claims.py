"""Results of the build -> the chapter's claims with their verdicts: claims.json, and claims.md to read.

In a build with other parameters than the chapter's, or other settings, those that depend on these are not judged.
"""

import json
from pathlib import Path

from vibroimpact_pipeline.jobs import running
from vibroimpact_pipeline.studies.claims_config import departures_by_part
from vibroimpact_pipeline.studies.claims_evidence import evidence

import yaml

from vibroimpact.studies.claims.judge import judge, to_markdown

with running(snakemake) as out:
    config, inputs = snakemake.params.config, dict(snakemake.input.items())
    listed = yaml.safe_load(Path(inputs["claims"]).read_text(encoding="utf-8"))
    others = departures_by_part(config, listed["judged_with"])
    judged = judge(listed["claims"], evidence(config, inputs, others))
    Path(out.json).write_text(json.dumps(judged, indent=1) + "\n", encoding="utf-8")
    Path(out.markdown).write_text(to_markdown(judged, dict.fromkeys(others.values())), encoding="utf-8")
