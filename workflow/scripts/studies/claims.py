"""Judge the claims of the chapter from the results of the build, and write claims.json."""

import json
from pathlib import Path

from vibroimpact_pipeline.jobs import running
from vibroimpact_pipeline.studies.claims_evidence import evidence

import yaml

from vibroimpact.studies.claims.judge import NOT_JUDGED, judge

with running(snakemake) as out:
    inputs, reason = dict(snakemake.input.items()), snakemake.params.not_judged
    claims = yaml.safe_load(Path(inputs["claims"]).read_text(encoding="utf-8"))["claims"]
    if reason:
        judged = [claim | {"verdict": NOT_JUDGED, "reason": reason, "parts": {}, "numbers": {}} for claim in claims]
    else:
        judged = judge(claims, evidence(inputs))
    Path(out.json).write_text(json.dumps(judged, indent=1) + "\n", encoding="utf-8")
