"""The chapter does without the studies: every folder and file of that name can be deleted."""

import os
import shutil
import subprocess
import sys

import pytest

from pipeline_trees import ROOT, Tree, whole_copy

QUICK = "tests/system", "tests/theory", "tests/pipeline", "tests/figures/test_specs.py", "tests/test_command_line.py"
"""Tests that need no build."""


@pytest.fixture
def chapter_alone(alone, tmp_path) -> Tree:
    """The built chapter without the studies, with the tests that are left."""
    tree = whole_copy(alone, tmp_path / "tree")
    shutil.copytree(ROOT / "tests", tree / "tests", ignore=shutil.ignore_patterns("__pycache__", "studies"))
    return tree


def tests_in(tree, *arguments):
    """Run tests of the tree with its own library."""
    environment = os.environ | {"PYTHONPATH": str(tree / "src"), "PYTHONDONTWRITEBYTECODE": "1"}
    command = [sys.executable, "-m", "pytest", "-q", "-p", "no:cacheprovider", *arguments]
    ended = subprocess.run(command, cwd=tree.path, env=environment, capture_output=True, text=True)
    assert ended.returncode == 0, ended.stdout[-3000:] + ended.stderr[-1000:]


def test_without_the_studies_the_chapter_is_built_checked_and_tested(chapter_alone):
    assert chapter_alone.planned() <= {"index"}  # results of the same code are up to date
    chapter_alone.snakemake("--forcerun", "orbits", "verdicts", "gather", "simulation", "fig10_01", "fig10_04", "index")
    assert "11 figures: 11 passed" in chapter_alone.snakemake("figure_check")
    tests_in(chapter_alone, "--collect-only")
    tests_in(chapter_alone, *QUICK)


def test_names_of_the_studies_say_what_is_missing(chapter_alone):
    code = "import vibroimpact as vi\ntry:\n    vi.branches\nexcept ImportError as error:\n    print(error)"
    environment = os.environ | {"PYTHONPATH": str(chapter_alone / "src")}
    said = subprocess.run([sys.executable, "-c", code], env=environment, capture_output=True, text=True, check=True)
    assert "vibroimpact.branches belongs to the studies" in said.stdout


@pytest.mark.thorough
def test_all_of_the_chapter_is_built_and_tested_without_the_studies(chapter_alone):
    shutil.rmtree(chapter_alone / "results")
    shutil.rmtree(chapter_alone / ".snakemake")
    chapter_alone.snakemake()
    assert "11 figures: 11 passed" in chapter_alone.snakemake("figure_check")
    tests_in(chapter_alone)
