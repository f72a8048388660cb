"""The blocks of docs/tutorial.md run one after another, and their results are those that the page states."""

import re

import matplotlib
import numpy as np
import pytest
from PIL import Image

from pipeline_trees import ROOT

pytestmark = pytest.mark.thorough
PAGE = (ROOT / "docs/tutorial.md").read_text(encoding="utf-8")
BLOCKS = re.findall(r"```python\n(.*?)```", PAGE, re.DOTALL)
PICTURES = re.findall(r"!\[.*?\]\((.*?)\)", PAGE)


@pytest.fixture(scope="module")
def followed(tmp_path_factory):
    """Return the variables after all blocks, and the folder of the pictures that the blocks save."""
    folder, names = tmp_path_factory.mktemp("tutorial"), {}
    with pytest.MonkeyPatch.context() as patch:
        patch.chdir(folder)
        for number, block in enumerate(BLOCKS, 1):
            exec(compile(block, f"block {number} of the tutorial", "exec"), names)
    return names, folder


def test_every_block_is_python_or_the_installation():
    assert len(BLOCKS) >= 8
    assert PAGE.count("```") == 2 * (len(BLOCKS) + PAGE.count("```sh"))


def test_the_table_of_fixed_points_is_the_printed_one(followed):
    rows = re.findall(r"^\| ([abc]) \| (.*) \|$", PAGE, re.MULTILINE)
    points = {point.label: point.row() for point in followed[0]["points"]}
    assert [label for label, _ in rows] == [point.label for point in followed[0]["points"]]
    for label, cells in rows:
        point = points[label]
        numbers = [f"{point[name]:.3f}" for name in ("C1", "C2", "B1", "B2")]
        assert cells.split(" | ") == [*numbers, point["fast"], point["slow"], point["theory"]]


def test_orbits_and_runs_are_as_the_page_states(followed):
    names = followed[0]
    stable = [orbit for orbit in names["orbits"] if orbit.stable]
    assert sum(orbit.symmetric for orbit in names["orbits"]) == 3
    assert [orbit.symmetric for orbit in stable] == [False, False]
    stated = [float(value) for value in re.search(r"\$C = \(([\d.]+), ([\d.]+)\)\$", PAGE).groups()]
    np.testing.assert_allclose([orbit.C for orbit in stable], [stated] * 2, atol=5.01e-4)
    assert names["certificate"].decided
    assert names["orbits"][int(np.argmin(names["ends"]))] in stable
    assert min(names["ends"]) < 0.02
    assert not names["weak"].certificate.decided


def test_the_diagram_is_as_the_page_states(followed):
    table, branches = followed[0]["table"], followed[0]["branches"]
    exact = table[table["family"] == "asymmetric orbit"]
    lost = exact.loc[exact["special"] == "Neimark-Sacker", "p"].unique()
    assert f"{lost[0]:.3f}" in PAGE
    assert len(lost) == 1
    assert exact[exact["stable"]]["p"].min() == pytest.approx(lost[0])
    assert not table[(table["family"] == "symmetric orbit") & table["stable"]].size
    assert table[(table["family"] == "fixed point") & table["stable"]].groupby(["branch", "piece"]).ngroups == 1
    assert {branch.family.name for branch in branches} == set(followed[0]["colours"])


@pytest.mark.parametrize("name", PICTURES)
def test_a_picture_of_the_page_is_the_one_that_its_code_draws(followed, name):
    """Pixels are compared only if this version of Matplotlib drew the picture of the page."""
    shown, drawn = (Image.open(folder / name) for folder in (ROOT / "docs", followed[1]))
    assert (ROOT / "docs" / name).stat().st_size < 50_000
    assert shown.size == drawn.size
    if matplotlib.__version__ in shown.info["Software"]:
        pixels = [np.asarray(picture.convert("L"), float) for picture in (shown, drawn)]
        assert abs(pixels[0] - pixels[1]).mean() < 0.2
