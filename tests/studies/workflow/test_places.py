"""The report of rules that another workflow has as a module stays below its prefix."""

import sys

import pytest

from pipeline_trees import Tree

OUTER = """
module weaker:
    snakefile: "{snakefile}"
    config: {{"system": {{"kappa": 0.6}}}}
    prefix: "weaker"
use rule * from weaker as weaker_*
"""


@pytest.mark.thorough
def test_report_of_a_module_stays_below_its_prefix(tree, tmp_path):
    outer = Tree(tmp_path / "outer")
    outer.path.mkdir()
    (outer / "Snakefile").write_text(OUTER.format(snakefile=tree / "workflow/Snakefile"))
    (outer / ".venv").symlink_to(sys.prefix)
    outer.snakemake("weaker_report", prefix=[outer / ".venv/bin/python"])
    assert (outer / "weaker/results/report/index.html").is_file()
    assert not (outer / "results").exists()
