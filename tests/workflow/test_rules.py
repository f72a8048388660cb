"""Each rule names the code that its results depend on, so that a change of it makes them anew."""

import re

import pytest

from pipeline_trees import ROOT

RECORDS = {"jobs", "provenance", "result_records", "code", "specs"}
"""Modules of the pipeline that write results down, or give what the params of the rule hold."""
NAMES = {"LIBRARY": "library", "FIGURES": "library figures", "PIPELINE": "library figures pipeline"}


def rules():
    """Yield every script of a rule with the parts of the checkout that the rule's params name."""
    for file in sorted((ROOT / "workflow/rules").glob("*.smk")):
        for rule in re.split(r"\n+ *(?:use )?rule\b.*", file.read_text(encoding="utf-8"))[1:]:
            if script := re.search(r'"\.\./scripts/(\w+\.py)"', rule):
                params = re.search(r"code=(.*)", rule) or re.search(r"()\*\*scene\(", rule)
                yield script[1], " ".join(NAMES.get(word, word) for word in re.findall(r"\w+", params[1] or "PIPELINE"))


@pytest.mark.parametrize(("script", "parts"), sorted(set(rules())))
def test_a_rule_names_all_code_that_its_script_uses(script, parts):
    text = (ROOT / "workflow/scripts" / script).read_text(encoding="utf-8")
    drawing = re.search(r"(from|import) vibroimpact\.figures", text)
    pipeline = re.findall(r"from vibroimpact_pipeline(?:\.(\w+)\S*)? import (\w+)", text)
    assert "library" in parts
    assert "figures" in parts or not drawing
    assert "pipeline" in parts or not {module or name for module, name in pipeline} - RECORDS


def test_all_rules_with_scripts_were_read():
    scripts = {script for script, _ in rules()}
    assert scripts > {"fixed_points.py", "simulate.py", "notebook.py", "figure.py", "claims.py", "report.py"}
