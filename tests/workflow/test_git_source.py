"""Test the rules from a git source, in a directory without a checkout and with the wheel installed."""

import json
import os
import subprocess
import sys
import zipfile

import pytest

from archives import commit, git
from compiled_code import share
from pipeline_trees import ROOT, SNAKEMAKE, Tree

FIGURE, TABLE = "fig10_03", "results/fixed_points/equal.csv"
"""A figure with a page from a packaged notebook, and a table from a script; both take seconds."""
OUTER = """
module vibroimpact:
    snakefile: github("owner/vibroimpact", path="workflow/Snakefile", {ref})
    config: {{}}
use rule * from vibroimpact as chapter_*
"""


@pytest.fixture(scope="module")
def wheel(tmp_path_factory):
    """Return the folder of an installed wheel."""
    folder = tmp_path_factory.mktemp("wheel")
    build = [sys.executable, "-m", "hatchling", "build", "--target", "wheel", "--directory", folder / "dist"]
    subprocess.run(build, cwd=ROOT, check=True, capture_output=True)
    (packed,) = (folder / "dist").glob("*.whl")
    with zipfile.ZipFile(packed) as files:
        files.extractall(folder / "site")
    share(folder / "site/vibroimpact")
    return folder / "site"


@pytest.fixture
def outer(tree, tmp_path, wheel):
    """Return a function that runs a workflow with rules from a git commit; a local folder stands for GitHub."""
    commit(tree.path)
    folder = Tree(tmp_path / "outer")
    folder.path.mkdir()
    environment = {
        "PYTHONPATH": str(wheel),
        "HOME": str(tmp_path / "home"),
        "XDG_CACHE_HOME": str(tmp_path / "cache"),
        "GIT_CONFIG_COUNT": "1",
        "GIT_CONFIG_KEY_0": f"url.file://{tmp_path}/.insteadOf",
        "GIT_CONFIG_VALUE_0": "https://github.com/",
    }

    def run(*arguments):
        (tmp_path / "owner").mkdir(exist_ok=True)
        source = tmp_path / "owner/vibroimpact"
        if not source.exists():
            git(tmp_path, "clone", "--bare", tree.path, source)
        named = git(tree.path, "rev-parse", "HEAD")
        (folder / "Snakefile").write_text(OUTER.format(ref=f'commit="{named}"'))
        done = subprocess.run(
            [*SNAKEMAKE, *arguments],
            cwd=folder.path,
            env={name: value for name, value in os.environ.items() if name != "PYTHONPATH"} | environment,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
            check=False,
        )
        return done.returncode, done.stdout

    run.path = folder.path
    return run


def record_of(figure, results):
    record = json.loads((results / f"figures/{figure}.provenance.json").read_text())
    return {name: value for name, value in record.items() if name not in ("commit", "tree")}


@pytest.mark.thorough
def test_figures_are_those_of_the_checkout_and_are_made_once(outer, built):
    targets = f"chapter_{FIGURE}", TABLE
    status, said = outer(*targets)
    assert status == 0, said
    for name in (TABLE, *(f"results/figures/{FIGURE}.{kind}" for kind in ("csv", "png", "pdf", "svg"))):
        assert (outer.path / name).read_bytes() == (built / name).read_bytes(), name
    assert record_of(FIGURE, outer.path / "results") == record_of(FIGURE, built / "results")
    status, said = outer("--dry-run", *targets)
    assert "Nothing to be done" in said, said


def test_rules_of_another_commit_than_the_installed_package_are_refused(tree, outer):
    tree.edit("workflow/scripts/notebook.py", '"""Write one page', '"""Write a page')
    commit(tree.path)
    status, said = outer("--dry-run", f"chapter_{FIGURE}")
    assert status == 1
    assert said.splitlines()[-1] == (
        "workflow/scripts/notebook.py: differs from the installed vibroimpact. Install vibroimpact of the same commit."
    ), said
