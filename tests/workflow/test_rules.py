"""Each rule names the code that its results depend on, so that a change of it makes them anew."""

import ast
import re

import pytest

from pipeline_trees import ROOT


def rules():
    """Yield every script of a rule with the script whose code the params of the rule name."""
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
def test_nothing_follows_the_work_of_a_job(script):
    """A job ends with `running`: a line after it, such as the exit status of a check, would not run."""
    last = ast.parse((ROOT / f"workflow/scripts/{script}.py").read_text(encoding="utf-8")).body[-1]
    assert isinstance(last, ast.With)
    assert ast.unparse(last.items[0].context_expr) == "running(snakemake)"


def test_all_scripts_of_the_workflow_were_read():
    """But those that no rule runs; the chapter may have no figure that is made by a script alone."""
    folder = ROOT / "workflow/scripts"
    scripts = {path.relative_to(folder).with_suffix("").as_posix() for path in folder.rglob("*.py")}
    assert {script for script, _ in rules()} | {"figure"} == scripts - {"benchmark", "compile"}
