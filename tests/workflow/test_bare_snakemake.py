"""With Snakemake alone installed, the workflow parses, is linted, listed and planned; a build says what is missing."""

import os
import subprocess
import sys
from importlib.metadata import PackageNotFoundError, packages_distributions, requires

import pytest
from packaging.requirements import Requirement

from pipeline_trees import ROOT

HIDE = """
import sys

class Hidden:
    def find_spec(self, name, path=None, target=None):
        if name in {hidden!r}:
            raise ModuleNotFoundError(f"No module named {{name!r}}", name=name)

sys.meta_path.insert(0, Hidden())
import importlib.util
find_spec = importlib.util.find_spec
importlib.util.find_spec = lambda name, package=None: None if name in {hidden!r} else find_spec(name, package)
"""


def closure(name, known):
    """The distributions that one needs, with their own needs."""
    if name in known:
        return known
    known.add(name)
    try:
        needed = [Requirement(text) for text in requires(name) or ()]
    except PackageNotFoundError:
        return known
    for one in needed:
        if one.marker is None or one.marker.evaluate({"extra": ""}):
            closure(one.name.lower().replace("_", "-"), known)
    return known


@pytest.fixture(scope="module")
def bare(tmp_path_factory):
    """Runs Snakemake with every module hidden that it does not need itself."""
    kept = closure("snakemake", set())
    hidden = {
        module
        for module, owners in packages_distributions().items()
        if not {owner.lower().replace("_", "-") for owner in owners} & kept
    }
    hidden -= {"vibroimpact", "vibroimpact_pipeline"}
    assert {"numpy", "scipy", "numba", "matplotlib", "pandas", "papermill"} <= hidden
    folder = tmp_path_factory.mktemp("bare")
    (folder / "sitecustomize.py").write_text(HIDE.format(hidden=hidden))

    def run(*arguments):
        command = [sys.executable, "-m", "snakemake", "--snakefile", str(ROOT / "Snakefile"), *arguments]
        environment = {**os.environ, "PYTHONPATH": f"{folder}"}
        done = subprocess.run(
            command,
            cwd=folder,
            env=environment,
            text=True,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            check=False,
        )
        return done.returncode, done.stdout

    return run


@pytest.mark.parametrize(
    "asked",
    [["--list"], ["--dry-run", "--cores", "1"], ["--rulegraph"], ["--summary"], ["--lint"]],
    ids=lambda asked: asked[0],
)
def test_the_workflow_parses(bare, asked):
    status, said = bare("--workflow-profile", "none", *asked)
    assert "Traceback" not in said
    assert status == 0 or asked == ["--lint"], said
    assert "fig10_06" in said or asked in (["--summary"], ["--lint"])


def test_the_schema_refuses_what_is_wrong(bare, tmp_path):
    (tmp_path / "try.yaml").write_text("system: {kappa: 1.5}\n")
    status, said = bare("--dry-run", "--cores", "1", "--configfile", str(tmp_path / "try.yaml"))
    assert status != 0
    assert "kappa" in said


def test_a_build_says_what_to_install(bare):
    status, said = bare("--cores", "1", "fig10_04")
    assert status != 0
    assert "Traceback" not in said
    assert "Not installed: numpy" in said
    assert "make set-up" in said
