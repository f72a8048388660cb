"""Test that each rule names the code on which its results depend, so that changed code reruns the rule."""

import ast
import re

import pytest

from pipeline_trees import ROOT


def rules():
    """For each rule, yield its script and the script that its params name for the fingerprint."""
    for file in sorted((ROOT / "workflow/rules").rglob("*.smk")):
        for rule in re.split(r"\n+ *(?:use )?rule\b.*", file.read_text(encoding="utf-8"))[1:]:
            if script := re.search(r'"(?:\.\./)+scripts/([\w/]+)\.py"', rule):
                drawn = r"\*\*(?:scene\(|chart\(|found\.params)()"
                params = re.search(r'code=code\(\s*"([\w/]+)"', rule) or re.search(drawn, rule)
                yield script[1], params and (params[1] or "figure")


@pytest.mark.parametrize(("script", "named"), sorted(set(rules())))
def test_a_rule_names_the_code_of_its_script(script, named):
    assert script == named


@pytest.mark.parametrize("script", sorted({script for script, _ in rules()}))
def test_no_code_follows_the_block_of_a_job(script):
    """The process ends with the block of `running`; a line below, such as a check's exit status, would not run."""
    last = ast.parse((ROOT / f"workflow/scripts/{script}.py").read_text(encoding="utf-8")).body[-1]
    assert isinstance(last, ast.With)
    assert ast.unparse(last.items[0].context_expr) == "running(snakemake)"


def test_rules_use_all_scripts_of_the_workflow():
    """`benchmark` and `compile` are excepted, since no rule runs them."""
    folder = ROOT / "workflow/scripts"
    scripts = {path.relative_to(folder).with_suffix("").as_posix() for path in folder.rglob("*.py")}
    assert {script for script, _ in rules()} | {"figure"} == scripts - {"benchmark", "compile"}
