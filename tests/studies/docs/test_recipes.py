"""The recipes of docs/howto.md work if they are followed step by step in a copy of the project."""

import json
import math
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pandas as pd
import pytest

from pipeline_trees import ROOT, copied, whole_copy

RECIPES = dict(
    section.split("\n", 1) for section in (ROOT / "docs/howto.md").read_text(encoding="utf-8").split("\n## ")[1:]
)

BLOCK = r"\s+```\w*\n(.*?)```"
STEPS = re.compile(
    rf"Append\s+to\s+`(?P<append>[^`]+)`:{BLOCK}"
    rf"|Add\s+to\s+`(?P<add>[^`]+)`,\s+below\s+`(?P<line>[^`]+)`:{BLOCK}"
    rf"|(?P<run>Run):{BLOCK}",
    re.DOTALL,
)


@pytest.fixture
def project(studied, tmp_path):
    """Return a copy of the project after a build, with its tests; it uses its own library."""
    tree = whole_copy(studied, tmp_path / "project")
    shutil.copytree(ROOT / "tests", tree / "tests", ignore=shutil.ignore_patterns("__pycache__"))
    return tree


def follow(recipe: str, project) -> list[str]:
    """Follow every step of a recipe, and return the output of its commands."""
    printed = []
    for step in STEPS.finditer(RECIPES[recipe]):
        named = STEPS.groupindex.values()
        texts = [text for number, text in enumerate(step.groups(), 1) if text and number not in named]
        if step["append"]:
            with open(project / step["append"], "a", encoding="utf-8") as file:
                file.write(texts[0])
        elif step["add"]:
            project.edit(step["add"], step["line"] + "\n", step["line"] + "\n" + texts[0])
        else:
            printed.append(run(texts[0], project))
    return printed


def run(command: str, project) -> str:
    """Run a command of a recipe in the environment of these tests, and return its output."""
    variables = {name: value for name, value in os.environ.items() if not name.startswith("PYTEST")}
    variables |= {"PATH": f"{Path(sys.executable).parent}:{os.environ['PATH']}", "PYTHONPATH": str(project / "src")}
    output = {"stdout": subprocess.PIPE, "stderr": subprocess.STDOUT, "text": True}
    done = subprocess.run(["bash", "-ec", command], cwd=project.path, env=variables, **output, check=False)
    assert done.returncode == 0, done.stdout
    return done.stdout


@pytest.mark.parametrize("recipe", RECIPES)
def test_every_block_of_a_recipe_is_a_step_that_a_test_follows(recipe):
    text = RECIPES[recipe]
    assert sum(step.group().count("```") for step in STEPS.finditer(text)) == text.count("```") > 0
    assert f'"{recipe}"' in Path(__file__).read_text(encoding="utf-8")


@pytest.mark.thorough
def test_a_figure_can_be_added(project):
    follow("Add a figure", project)
    table = pd.read_csv(project / "results/figures/companion_mine.csv")
    # Half a period of free flight at W' - U' = -2 C / pi takes the ball from wall to wall: (10.14) at kappa = 1.
    assert table["speed"].iloc[-1] == pytest.approx(4 * table["C"].iloc[-1] / (math.pi * 1.65))
    folder = project / "results/figures"
    record = json.loads((folder / "companion_mine.provenance.json").read_text())
    assert set(record["config"]) == {"system.kappa", "figures.fig10_04.C_max"}
    dictionary = "from vibroimpact_pipeline.data_dictionary import page, read; print(page(*read()))"
    described = run(f'python -c "{dictionary}"', project)
    assert "| `speed` | $W_i'$ just before an impact, (10.12) | dimensionless |" in described
    drawn = "companion_mine.png", "companion_mine.pdf", "companion_mine.svg", "strong_planes.png", "strong_motion.png"
    assert min((folder / name).stat().st_size for name in drawn) > 1000


@pytest.mark.thorough
def test_an_integrator_can_be_added(project):
    _, printed = follow("Add an integrator", project)
    assert "." in printed.splitlines()[0]
    listed = run("python -c 'from vibroimpact.integrators import METHODS; print([m.name for m in METHODS])'", project)
    assert "symplectic Euler" in listed


@pytest.mark.thorough
@pytest.mark.parametrize("recipe", ["Add a stress test", "Add a claim"])
def test_the_commands_of_a_recipe_pass(recipe, project):
    follow(recipe, project)


@pytest.mark.thorough
def test_parameters_can_be_swept(project):
    (printed,) = follow("Sweep parameters", project)
    columns, first, second = (line.split(",") for line in printed.splitlines()[-3:])
    assert columns[:4] == ["point", "alpha12_hat", "f10_hat", "f20_hat"]
    assert [first[:4], second[:4]] == [["0", "0.5", "0.5", "0.5"], ["1", "0.5", "0.8", "0.8"]]
    table = pd.read_csv(project / "results/sweeps/coupling.csv")
    assert table["point"].tolist() == list(range(12))
    for kind in ("png", "pdf", "svg"):
        assert (project / f"results/sweeps/coupling/figure.{kind}").stat().st_size > 1000


@pytest.mark.thorough
def test_machines_can_be_designed(tmp_path):
    """Numbers in closed form are those of the page; peaks are within 10 % of those of the page.

    Chaotic motions differ between processors, and so does the best clearance.
    """
    project = copied(ROOT, tmp_path / "project")
    (page,) = re.findall(r"prints:\n\n((?: {4}.*\n)+)", RECIPES["Design a machine"])
    designed, coupled = follow("Design a machine", project)
    number, notes = r"\d+(?:\.\d+)?", r"^.*(?:compiling|had not settled).*\n"
    lines, printed = (re.sub(notes, "", text.replace("    ", ""), flags=re.M).splitlines() for text in (designed, page))
    assert [re.sub(number, "", line) for line in lines] == [re.sub(number, "", line) for line in printed]
    for one, other in zip(lines, printed, strict=True):
        if "largest displacement" in one:
            peaks, expected = ([float(n) for n in re.findall(number, line)] for line in (one, other))
            assert peaks == pytest.approx(expected, rel=0.1)
        elif any(words in one for words in ("absorber", "natural")):
            assert one == other
    for linear in ("without balls: up to 26.82 mm", "best absorbers: up to 2.85 mm"):
        assert linear in coupled
    assert coupled.count("L = ") == 4
    assert (project / "design.png").exists()
    table = pd.read_csv(project / "design.csv")
    assert table["with_m"].max() < 0.4 * table["without_m"].max()
