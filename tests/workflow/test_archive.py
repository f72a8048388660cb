"""An archive is the same each time, and in an empty place it makes a figure again, byte by byte."""

import hashlib
import json
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from archives import archive_of, commit, git, unpacked
from pipeline_trees import ROOT, whole_copy
from vibroimpact_pipeline.archive import results_behind
from vibroimpact_pipeline.result_records import write_record

FIGURE = "results/figures/fig10_04"
HERE = str(Path(sys.executable).parent)
SET_UP = ["make set-up", ". .venv/bin/activate"]
"""What the test does not do: it has an environment."""


def commands() -> list[str]:
    """What docs/running.md says to do in the unpacked folder."""
    (block,) = re.findall(r"In the unpacked folder .*?```\n(.*?)```", (ROOT / "docs/running.md").read_text(), re.DOTALL)
    lines = block.splitlines()
    assert lines[: len(SET_UP)] == SET_UP
    return lines[len(SET_UP) :]


@pytest.fixture
def elsewhere(archived, tmp_path):
    """The archive unpacked inside a repository that has nothing to do with it."""
    (tmp_path / "file").touch()
    commit(tmp_path)
    return unpacked(archive_of(archived), tmp_path)


def test_the_name_tells_version_and_commit(archived):
    commit = git(archived.path, "rev-parse", "HEAD")
    version = re.search(r'^version = "(.*)"', (ROOT / "pyproject.toml").read_text(), re.MULTILINE)[1]
    assert archive_of(archived).name == f"vibroimpact-{version}-{commit[:12]}.tar.gz"


def test_results_on_demand_stay_out(tmp_path, monkeypatch):
    """They may be of an older commit; a second output of a rule that is needed goes in."""
    monkeypatch.chdir(tmp_path)
    made = {"table.csv": ("solve", []), "figure.png": ("draw", ["table.csv"]), "figure.csv": ("draw", ["table.csv"])}
    for name, (rule, inputs) in (made | {"report.html": ("report", ["figure.png"])}).items():
        Path("results", name).parent.mkdir(exist_ok=True)
        Path("results", name).write_text(name)
        write_record(Path("results", name), {"rule": rule, "inputs": {f"results/{one}": "" for one in inputs}})
    assert results_behind(["results/figure.png"]) == sorted(Path("results", name) for name in made)


@pytest.mark.thorough
def test_the_same_bytes_twice(archived, tmp_path):
    """In another place, with other settings of the user."""
    tree = whole_copy(archived, tmp_path / "tree")
    shutil.rmtree(tree / "results/archive")
    tree.snakemake("archive", TZ="Asia/Tokyo", LC_ALL="C", PYTHONHASHSEED="1")
    assert archive_of(tree).read_bytes() == archive_of(archived).read_bytes()


def test_the_commands_of_the_readme_make_a_figure_again(elsewhere):
    before = {path: path.read_bytes() for path in elsewhere.path.glob(f"{FIGURE}.*")}
    done = subprocess.run(
        ["bash", "-e", "-c", "\n".join(commands())],
        cwd=elsewhere.path,
        env={**os.environ, "PATH": f"{HERE}:{os.environ['PATH']}", "PYTHONPATH": str(elsewhere / "src")},
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stdout + done.stderr
    made = {path for path in before if path.read_bytes() != before[path]}
    assert made <= {elsewhere / f"{FIGURE}.provenance.json"}  # which tells the commit, if there was one
    assert (elsewhere / f"{FIGURE}.png").stat().st_mtime > (elsewhere / "README.md").stat().st_mtime
    assert "made from commit not known (without git)" in done.stdout
    assert done.stdout.endswith("It is what this checkout makes.\n")


def test_elsewhere_results_are_there_to_read_and_do_not_count_as_made(elsewhere):
    """Nobody knows there what they were made with."""
    assert {"fig10_04", "simulation", "work_precision"} <= elsewhere.planned()


def test_the_sums_of_all_files_are_in_the_archive(elsewhere):
    crate = json.loads((elsewhere / "ro-crate-metadata.json").read_text())["@graph"]
    sums = {entity["@id"]: entity["sha256"] for entity in crate if "sha256" in entity}
    assert {f"{FIGURE}.png", f"{FIGURE}.csv", "config/config.yaml"} <= sums.keys()
    assert sums == {name: hashlib.sha256((elsewhere / name).read_bytes()).hexdigest() for name in sums}


def test_elsewhere_there_is_no_archive_without_git(elsewhere):
    said = elsewhere.snakemake("archive", check=False)
    assert elsewhere.returncode == 1
    assert "archive: there is no git" in said
    assert "Traceback" not in said


def test_a_container_has_the_checkout_that_an_archive_needs():
    """Docker reads patterns as git does, but for those without a slash, which git also finds further below."""
    assert git(ROOT, "ls-files", "--cached", "--ignored", "--exclude-from=.dockerignore") == ""
    assert not {".git", "**/.git", ".*"} & set((ROOT / ".dockerignore").read_text().split())
