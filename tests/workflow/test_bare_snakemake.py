"""Test that Snakemake alone can parse, lint, list and plan the workflow, and that a build names missing packages."""

import subprocess
import venv
from importlib.metadata import PackageNotFoundError, distribution, files, requires

import pytest
from packaging.requirements import Requirement

from pipeline_trees import ROOT


def closure(name, known):
    """Return the distributions that a distribution requires, directly or indirectly."""
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
    """Return a function that runs Snakemake in an environment with only Snakemake and its requirements."""
    folder = tmp_path_factory.mktemp("bare")
    venv.create(folder / "venv", with_pip=False)
    python = folder / "venv/bin/python"
    (packages,) = (folder / "venv/lib").glob("python*/site-packages")
    for name in closure("snakemake", set()):
        for top in {file.parts[0] for file in files(name) if file.parts[0] != ".."}:
            (packages / top).symlink_to(distribution(name).locate_file(top))
    assert subprocess.run([python, "-c", "import numpy"], stderr=subprocess.DEVNULL, check=False).returncode

    def run(*arguments):
        command = [python, "-m", "snakemake", "--snakefile", str(ROOT / "Snakefile"), *arguments]
        done = subprocess.run(
            command,
            cwd=folder,
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
    assert "Packages not installed: numpy" in said
    assert "make set-up" in said
