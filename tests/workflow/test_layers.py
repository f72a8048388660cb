"""Test that the chapter works after every folder and file named `studies` has been deleted."""

import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

import vibroimpact as vi
from pipeline_trees import ROOT, Tree, whole_copy

REFER_TO_STUDIES = {
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
"""Files that may refer to parts of the studies, since they check first that the studies exist."""
REFERENCE = re.compile(r"\bstudies[/.](?!smk\b|yaml\b)\w|\b(?:from|import) studies\b|\bstudies\.(?:smk|yaml)\b")
NAMES_OF_STUDIES = {name for name, module in vi._PUBLIC.items() if module.startswith("vibroimpact.studies")}
"""Public names that need the studies."""


SUFFIXES = (".py", ".pyi", ".ipynb", ".smk", ".sh", ".yaml", ".txt", "")


def sources():
    """Yield path and text of each file outside the studies."""
    for top in ("src", "workflow", "tests", "notebooks"):
        for path in sorted((ROOT / top).rglob("*")):
            name = path.relative_to(ROOT)
            of_chapter = not any(part.partition(".")[0] in ("studies", "__pycache__", "") for part in name.parts)
            if of_chapter and path.suffix in SUFFIXES and path.is_file():
                yield name.as_posix(), path.read_text(encoding="utf-8")


def test_files_outside_the_studies_do_not_refer_to_parts_of_the_studies():
    texts = dict(sources())
    assert len(texts) > 250
    assert {name for name, text in texts.items() if REFERENCE.search(text)} == REFER_TO_STUDIES
    public = re.compile(rf"\bvi\.(?:{'|'.join(NAMES_OF_STUDIES)})\b")
    assert {name for name, text in texts.items() if public.search(text)} <= {"tests/workflow/test_layers.py"}


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
    done = run(tree, "-m", "pytest", "-q", "-p", "no:cacheprovider", *arguments)
    assert done.returncode == 0, done.stdout[-3000:] + done.stderr[-1000:]


PUBLIC_NAMES = """
import vibroimpact as vi
try:
    vi.branches
except ImportError as error:
    print(error)
vi.System, vi.orbits, vi.ensemble
"""


def test_the_chapter_without_the_studies_is_built_and_checked_and_pytest_collects_its_tests(chapter_alone):
    assert chapter_alone.planned() == set()  # results of the same code are up to date
    chapter_alone.snakemake("--forcerun", "fixed_points", "fig10_04", "--", "results/orbits/weak.csv", "fig10_04")
    assert re.search(r"\b(\d+) figures: \1 passed", chapter_alone.snakemake("figure_check"))
    assert_tests_pass(chapter_alone, "--collect-only")
    contracts = run(chapter_alone, str(Path(sys.executable).with_name("lint-imports")))
    assert contracts.returncode == 0, contracts.stdout
    listed = subprocess.run(["make", "-n", "test-quick"], cwd=chapter_alone.path, capture_output=True, text=True).stdout
    assert all((chapter_alone / path).exists() for path in re.findall(r"tests/\S+", listed))
    assert "tests/system" in listed
    assert "vibroimpact.branches needs the studies" in run(chapter_alone, "-c", PUBLIC_NAMES).stdout
    machine = "design --M 120 --m 6 --k 3e5 --c 120 --F 40 --from 7 --to 9"
    done = run(chapter_alone, "-m", "vibroimpact", *machine.split())
    assert done.returncode == 2
    assert "vibroimpact.design needs the studies" in done.stderr
    assert done.stderr.count("\n") == 1


@pytest.mark.thorough
def test_the_chapter_without_the_studies_is_built_from_scratch_and_passes_all_its_tests(chapter_alone):
    shutil.rmtree(chapter_alone / "results")
    shutil.rmtree(chapter_alone / ".snakemake")
    chapter_alone.snakemake()
    assert re.search(r"\b(\d+) figures: \1 passed", chapter_alone.snakemake("figure_check"))
    assert_tests_pass(chapter_alone, "--ignore", "tests/workflow/test_layers.py")
