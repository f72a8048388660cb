"""Test that the chapter does not need the studies: every folder and file named `studies` can be deleted."""

import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

import vibroimpact as vi
from pipeline_trees import ROOT, Tree, whole_copy

AWARE = {
    "src/vibroimpact/__init__.py",
    "src/vibroimpact/__init__.pyi",
    "src/vibroimpact_pipeline/config/reading.py",
    "src/vibroimpact_pipeline/config/schema.py",
    "src/vibroimpact_pipeline/figure_check/table_distances.py",
    "src/vibroimpact_pipeline/specs.py",
    "workflow/Snakefile",
    "workflow/rules/common.smk",
    "workflow/rules/figures.smk",
}
"""Files that refer to parts of the studies, after a check that the studies are installed."""
LAYER = re.compile(r"\bstudies[/.](?!smk\b|yaml\b)\w|\b(?:from|import) studies\b|\bstudies\.(?:smk|yaml)\b")
LAZY = {name for name, module in vi._PUBLIC.items() if module.startswith("vibroimpact.studies")}
"""Public names that need the studies."""


def sources():
    """Yield path and text of each file outside the studies."""
    for top in ("src", "workflow", "tests", "notebooks"):
        for path in sorted((ROOT / top).rglob("*")):
            name = path.relative_to(ROOT)
            own = not any(part.partition(".")[0] in ("studies", "__pycache__", "") for part in name.parts)
            if own and path.suffix in (".py", ".pyi", ".ipynb", ".smk", ".sh", ".yaml", ".txt", "") and path.is_file():
                yield name.as_posix(), path.read_text(encoding="utf-8")


def test_nothing_of_the_chapter_names_what_is_in_the_layer():
    texts = dict(sources())
    assert len(texts) > 250
    assert {name for name, text in texts.items() if LAYER.search(text)} == AWARE
    lazy = re.compile(rf"\bvi\.(?:{'|'.join(LAZY)})\b")
    assert {name for name, text in texts.items() if lazy.search(text)} <= {"tests/workflow/test_layers.py"}


@pytest.fixture
def chapter_alone(alone, tmp_path) -> Tree:
    """Return the built chapter and its tests without the studies."""
    tree = whole_copy(alone, tmp_path / "tree")
    shutil.copytree(ROOT / "tests", tree / "tests", ignore=shutil.ignore_patterns("__pycache__", "studies"))
    return tree


def run(tree, *arguments):
    """Run Python in a tree with the library of the tree."""
    environment = os.environ | {"PYTHONPATH": str(tree / "src"), "PYTHONDONTWRITEBYTECODE": "1", "THOROUGH": ""}
    command = [sys.executable, *arguments]
    return subprocess.run(command, cwd=tree.path, env=environment, capture_output=True, text=True, check=False)


def assert_tests_pass(tree, *arguments):
    ended = run(tree, "-m", "pytest", "-q", "-p", "no:cacheprovider", *arguments)
    assert ended.returncode == 0, ended.stdout[-3000:] + ended.stderr[-1000:]


SAID = """
import vibroimpact as vi
try:
    vi.branches
except ImportError as error:
    print(error)
vi.System, vi.orbits, vi.ensemble
"""


def test_without_the_studies_the_chapter_is_built_and_checked_and_its_tests_are_found(chapter_alone):
    assert chapter_alone.planned() == set()  # results of the same code are up to date
    made = "results/orbits/weak.csv", "fig10_04"
    chapter_alone.snakemake("--forcerun", "fixed_points", "fig10_04", "--", *made)
    assert re.search(r"\b(\d+) figures: \1 passed", chapter_alone.snakemake("figure_check"))
    assert_tests_pass(chapter_alone, "--collect-only")
    contracts = run(chapter_alone, str(Path(sys.executable).with_name("lint-imports")))
    assert contracts.returncode == 0, contracts.stdout
    listed = subprocess.run(["make", "-n", "test-quick"], cwd=chapter_alone.path, capture_output=True, text=True).stdout
    assert all((chapter_alone / path).exists() for path in re.findall(r"tests/\S+", listed))
    assert "tests/system" in listed
    assert "vibroimpact.branches needs the studies" in run(chapter_alone, "-c", SAID).stdout
    machine = "design --M 120 --m 6 --k 3e5 --c 120 --F 40 --from 7 --to 9"
    ended = run(chapter_alone, "-m", "vibroimpact", *machine.split())
    assert ended.returncode == 2
    assert "vibroimpact.design needs the studies" in ended.stderr
    assert ended.stderr.count("\n") == 1


@pytest.mark.thorough
def test_all_of_the_chapter_is_built_and_tested_without_the_studies(chapter_alone):
    shutil.rmtree(chapter_alone / "results")
    shutil.rmtree(chapter_alone / ".snakemake")
    chapter_alone.snakemake()
    assert re.search(r"\b(\d+) figures: \1 passed", chapter_alone.snakemake("figure_check"))
    assert_tests_pass(chapter_alone, "--ignore", "tests/workflow/test_layers.py")
