"""Judge the claims of the chapter by the results of the build; write claims.json, and claims.md for reading.

Claims that depend on parameters or settings other than those of claims.yaml are not judged.
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
