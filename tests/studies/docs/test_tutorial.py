"""docs/tutorial.md, its blocks run one after another as a reader would, and what it says of their results."""

import re
import time

import matplotlib
import numpy as np
import pytest
from PIL import Image

from pipeline_trees import ROOT

PAGE = (ROOT / "docs/tutorial.md").read_text(encoding="utf-8")
BLOCKS = re.findall(r"```python\n(.*?)```", PAGE, re.DOTALL)
PICTURES = re.findall(r"!\[.*?\]\((.*?)\)", PAGE)
BUDGET = 120  # seconds, on a busy machine; a minute of it compiles the engine where that has not happened yet


@pytest.fixture(scope="module")
def followed(tmp_path_factory):
    """The reader's names, the folder with the reader's pictures, and the seconds that all blocks took."""
    folder, names, started = tmp_path_factory.mktemp("tutorial"), {}, time.monotonic()
    with pytest.MonkeyPatch.context() as patch:
        patch.chdir(folder)
        for number, block in enumerate(BLOCKS, 1):
            exec(compile(block, f"block {number} of the tutorial", "exec"), names)
    return names, folder, time.monotonic() - started


def test_every_block_is_python_or_the_installation():
    assert len(BLOCKS) >= 8
    assert PAGE.count("```") == 2 * (len(BLOCKS) + PAGE.count("```sh"))


def test_it_takes_less_than_its_budget(followed):
    assert followed[2] < BUDGET


def test_the_table_of_fixed_points_is_the_printed_one(followed):
    rows = re.findall(r"^\| ([abc]) \| (.*) \|$", PAGE, re.MULTILINE)
    points = {point.label: point.row() for point in followed[0]["points"]}
    assert [label for label, _ in rows] == [point.label for point in followed[0]["points"]]
    for label, cells in rows:
        point = points[label]
        numbers = [f"{point[name]:.3f}" for name in ("C1", "C2", "B1", "B2")]
        assert cells.split(" | ") == [*numbers, point["fast"], point["slow"], point["theory"]]


def test_what_is_said_of_the_orbits(followed):
    orbits = followed[0]["orbits"]
    stable = [orbit for orbit in orbits if orbit.stable]
    assert sum(orbit.symmetric for orbit in orbits) == 3
    assert [orbit.symmetric for orbit in stable] == [False, False]
    said = [float(value) for value in re.search(r"\$C = \(([\d.]+), ([\d.]+)\)\$", PAGE).groups()]
    for orbit in stable:
        np.testing.assert_allclose(orbit.C, said, atol=5.01e-4)


def test_the_run_is_decided_and_tends_to_the_asymmetric_orbit(followed):
    names = followed[0]
    assert names["certificate"].decided
    assert names["certificate"].error < 1e-6
    assert names["jump"][290] < 0.01 * names["jump"][10]
    nearest = names["orbits"][int(np.argmin(names["ends"]))]
    assert not nearest.symmetric
    assert nearest.stable
    assert min(names["ends"]) < 0.02


def test_the_flights_of_the_second_ball_are_unequal_as_drawn(followed):
    impacts = followed[0]["later"].events
    second = impacts[impacts["module"] == 2]
    flights = np.diff(second["tau"]) / followed[0]["system"].period
    assert set(second["wall"][1:] * second["wall"][:-1]) == {-1}
    assert abs(flights - 0.5).min() > 0.1


def test_the_weak_response_is_modulated_and_beyond_its_horizon(followed):
    weak, cloud = followed[0]["weak"], followed[0]["cloud"]
    assert not weak.certificate.decided
    assert np.isfinite(weak.certificate.horizon)
    assert {1, 2} == set(weak.events["module"])
    assert len(np.unique(cloud[:, 2].round(3))) > 300  # no motion of few periods


def test_what_is_said_of_the_diagram(followed):
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
    """Wherever Matplotlib is the one that drew it: no pixel of the page is far from the reader's."""
    shown, drawn = (Image.open(folder / name) for folder in (ROOT / "docs", followed[1]))
    assert (ROOT / "docs" / name).stat().st_size < 50_000
    assert shown.size == drawn.size
    if matplotlib.__version__ in shown.info["Software"]:
        pixels = [np.asarray(picture.convert("L"), float) for picture in (shown, drawn)]
        assert abs(pixels[0] - pixels[1]).mean() < 0.2
