"""A build asks neither for a home nor for a name: containers run as a user who has none."""

import os
import subprocess
import sys

import pytest

from namespaces import unshared
from pipeline_trees import ROOT

FIGURE = "companion_10_04"
WITHOUT_PROFILE = "--workflow-profile", "none"
"""Then Snakemake has a cache of sources, by default in the home directory."""


@pytest.mark.parametrize("home", [os.devnull, "/proc/none"], ids=["a file", "missing, where nobody writes"])
def test_without_a_home(tree, home):
    assert FIGURE in tree.snakemake(*WITHOUT_PROFILE, "--dry-run", FIGURE, HOME=home, XDG_CACHE_HOME=None)


def test_a_user_without_a_name(tree):
    names = dict.fromkeys(("LOGNAME", "USER", "LNAME", "USERNAME", "XDG_CACHE_HOME"))
    tree.snakemake(FIGURE, prefix=unshared("--user", "--map-user=12345"), HOME="/proc/none", **names)
    assert (tree / f"results/figures/{FIGURE}.png").exists()


def test_nothing_comes_into_the_home(tree, tmp_path):
    home = tmp_path / "home"
    home.mkdir()
    tree.snakemake(*WITHOUT_PROFILE, "--dry-run", FIGURE, HOME=str(home), XDG_CACHE_HOME=None)
    assert list(home.iterdir()) == []


def test_a_command_of_the_pipeline_writes_nothing_elsewhere(tmp_path):
    """One that draws nothing, but imports Matplotlib; the reference set bears no record, which it says."""
    command = [sys.executable, "-m", "vibroimpact_pipeline.provenance.verify", "figures/fig10_06.png"]
    own = {name: value for name, value in os.environ.items() if not name.startswith(("MPL", "XDG_"))}
    environment = own | {"HOME": str(tmp_path), "TMPDIR": str(tmp_path)}
    run = subprocess.run(command, cwd=ROOT, env=environment, capture_output=True, text=True, check=False)
    assert "bears no record" in run.stderr
    assert list(tmp_path.iterdir()) == []


def test_make_has_a_home_where_nothing_tells_one():
    """Where the list of users does not either, Snakemake ends before it knows of this pipeline."""
    without = {name: value for name, value in os.environ.items() if name != "HOME"}
    command = ["make", "--silent", "--eval", "home: ; @echo $$HOME", "home"]
    run = subprocess.run(command, cwd=ROOT, env=without, capture_output=True, text=True, check=True)
    assert run.stdout == f"{ROOT}/.cache/home\n"
