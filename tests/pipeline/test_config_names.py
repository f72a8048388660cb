"""Names that figures and animations may not bear are exactly those that the pipeline takes itself."""

from configs import GOOD
from pipeline_trees import CORES, ROOT, run_module
from vibroimpact_pipeline.config.names import COMPANIONS, RULES, SWEEPS


def test_every_rule_is_known():
    _, output = run_module(ROOT, "snakemake", *CORES, "--list-rules", "--quiet", "all")
    rules = {line.strip() for line in output.splitlines() if line.strip().isidentifier()}
    own = {*GOOD["figures"], *GOOD["report"]["animations"]}
    assert own < rules, output
    assert {rule for rule in rules - own if not rule.startswith((COMPANIONS, *SWEEPS))} == set(RULES.split())
