"""Test that an archive is reproducible, and that it rebuilds a figure with identical bytes in an empty folder."""

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
"""Commands of docs/running.md that the tests skip, since they already have an environment."""


def commands() -> list[str]:
    """Return the commands that docs/running.md lists for the unpacked folder, without SET_UP."""
    (block,) = re.findall(r"In the unpacked folder .*?```\n(.*?)```", (ROOT / "docs/running.md").read_text(), re.DOTALL)
    lines = block.splitlines()
    assert lines[: len(SET_UP)] == SET_UP
    return lines[len(SET_UP) :]


@pytest.fixture
def elsewhere(archived, tmp_path):
    """Return the folder of the archive, unpacked inside an unrelated repository."""
    (tmp_path / "file").touch()
    commit(tmp_path)
    return unpacked(archive_of(archived), tmp_path)


def test_the_name_contains_version_and_commit(archived):
    commit = git(archived.path, "rev-parse", "HEAD")
    named = re.search(r'^version = "(.*)"', (ROOT / "pyproject.toml").read_text(), re.MULTILINE)[1]
    assert archive_of(archived).name == f"vibroimpact-{named}-{commit[:12]}.tar.gz"


def test_results_on_demand_are_excluded(tmp_path, monkeypatch):
    """Such results may be from an older commit. A second output of a needed rule is included."""
    monkeypatch.chdir(tmp_path)
    made = {"table.csv": ("solve", []), "figure.png": ("draw", ["table.csv"]), "figure.csv": ("draw", ["table.csv"])}
    for name, (rule, inputs) in (made | {"report.html": ("report", ["figure.png"])}).items():
        Path("results", name).parent.mkdir(exist_ok=True)
        Path("results", name).write_text(name)
        write_record(Path("results", name), {"rule": rule, "inputs": {f"results/{one}": "" for one in inputs}})
    assert results_behind(["results/figure.png"]) == sorted(Path("results", name) for name in made)


def test_a_config_on_the_command_line_prevents_an_archive(tree):
    """The archive would claim the wrong config, so nothing is built."""
    commit(tree.path)
    text = tree.dry_run("--config", "figures={fig10_04: {C_max: 3.0}}", "--", "archive")
    assert tree.returncode == 1
    assert re.search(r"archive: figures.fig10_04.C_max is 3.0, but 2.0 in config/config.yaml\b.*\. Build without", text)
    assert "Traceback" not in text


def test_an_archive_needs_a_commit_and_rebuilds_what_is_out_of_date(rebuilt):
    commit(rebuilt.path)
    rebuilt.edit("config/config.yaml", "C_range: [0.5, 1.1]", "C_range: [0.5, 1.2]")
    text = rebuilt.dry_run("archive")
    assert rebuilt.returncode == 1
    assert "archive: uncommitted changes in config/config.yaml; commit, ignore or remove them first" in text
    commit(rebuilt.path)
    assert {"fig10_05", "archive"} <= (planned := rebuilt.planned("archive"))
    assert "fig10_06" not in planned


@pytest.mark.thorough
def test_two_archives_of_a_commit_have_the_same_bytes(archived, tmp_path):
    """The second archive is made in another folder, with other settings of the user."""
    tree = whole_copy(archived, tmp_path / "tree")
    shutil.rmtree(tree / "results/archive")
    tree.snakemake("archive", TZ="Asia/Tokyo", LC_ALL="C", PYTHONHASHSEED="1")
    assert archive_of(tree).read_bytes() == archive_of(archived).read_bytes()


def test_the_commands_of_the_page_on_running_rebuild_a_figure(elsewhere):
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
    assert made <= {elsewhere / f"{FIGURE}.provenance.json"}  # it contains the commit, if there was one
    assert (elsewhere / f"{FIGURE}.png").stat().st_mtime > (elsewhere / "README.md").stat().st_mtime
    assert "made from commit unknown (without git)" in done.stdout
    assert done.stdout.endswith("No differences: this checkout makes the same figure.\n")


def test_results_of_an_unpacked_archive_do_not_count_as_built(elsewhere):
    """Without their records, the origin of the results is unknown."""
    assert {"fig10_04", "simulation", "work_precision"} <= elsewhere.planned()


def test_the_archive_contains_the_checksums_of_its_files(elsewhere):
    crate = json.loads((elsewhere / "ro-crate-metadata.json").read_text())["@graph"]
    sums = {entity["@id"]: entity["sha256"] for entity in crate if "sha256" in entity}
    assert {f"{FIGURE}.png", f"{FIGURE}.csv", "config/config.yaml"} <= sums.keys()
    assert sums == {name: hashlib.sha256((elsewhere / name).read_bytes()).hexdigest() for name in sums}


def test_an_unpacked_archive_cannot_be_archived_without_git(elsewhere):
    text = elsewhere.snakemake("archive", check=False)
    assert elsewhere.returncode == 1
    assert "archive: the pipeline is not a git checkout" in text
    assert "Traceback" not in text


def test_a_container_has_the_checkout_that_an_archive_needs():
    """Docker reads patterns like git, except patterns without a slash, which git also applies in subfolders."""
    if not (ROOT / ".git").exists():
        pytest.skip("not a git checkout")
    assert git(ROOT, "ls-files", "--cached", "--ignored", "--exclude-from=.dockerignore") == ""
    assert not {".git", "**/.git", ".*"} & set((ROOT / ".dockerignore").read_text().split())
