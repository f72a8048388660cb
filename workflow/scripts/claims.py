"""Results of the build -> the chapter's claims with their verdicts: claims.json, and claims.md to read.

In a build with other parameters than the chapter's, or other settings behind them, none is judged; both files say why.
"""

import json
from pathlib import Path

import yaml

from vibroimpact.claims.judge import judge, leave_open, to_markdown
from vibroimpact_pipeline.chapter import departures, unknown_entries
from vibroimpact_pipeline.evidence import evidence
from vibroimpact_pipeline.jobs import running

with running(snakemake) as out:
    config, inputs = snakemake.params.config, dict(snakemake.input.items())
    listed = yaml.safe_load(Path(inputs["claims"]).read_text(encoding="utf-8"))
    unlike = departures(config) or unknown_entries(config, listed["judged_with"])
    judged = leave_open(listed["claims"]) if unlike else judge(listed["claims"], evidence(config, inputs))
    Path(out.json).write_text(json.dumps(judged, indent=1) + "\n", encoding="utf-8")
    Path(out.markdown).write_text(to_markdown(judged, unlike), encoding="utf-8")
