"""Notebooks with parameters changed by a reader show results of these parameters, and write no files."""

import re
import subprocess
import sys

import nbformat
import numpy as np
import pytest
from nbclient import NotebookClient
from PIL import Image

import vibroimpact as vi
from chapter import system_of
from pipeline_trees import ROOT

SMALLER_FORCE = {"f20_hat = 1.0": "f20_hat = 0.72"}
RUNS = {
    "points": ("fixed_points", SMALLER_FORCE),
    "no points": ("fixed_points", SMALLER_FORCE | {"kappa = 0.65": "kappa = 0.3"}),
    "response": ("theoretical_response", SMALLER_FORCE | {'fixed_point = "c"': 'fixed_point = "b"'}),
    "motion": ("simulation", {"f20_hat = 1.0": "f20_hat = 0.5"}),
    "manifold": ("closed_form", {"kappa = 0.65": "kappa = 0.3"}),
    "drawing": ("drawings", {'"fig10_01"': '"fig10_02"'}),
}
WEAK = {'"f10_hat": 1.0': '"f10_hat": 0.5', '"f20_hat": 1.0': '"f20_hat": 0.5', '"play.gif"': '""'}
STICKING = {'"kappa": 0.65': '"kappa": 0.1', '"f10_hat": 1.0': '"f10_hat": 3.0', '"f20_hat": 1.0': '"f20_hat": 3.0'}
STICKING |= {'"play.gif"': '""', "compared = 40": "compared = 5"}
PLAYED = {
    "play": ("play", {}),
    "play weak": ("play", WEAK | {"compared = 40": "compared = 60"}),
    "play sticking": ("play", STICKING),
    "play light": ("play", {'"epsilon": 0.1': '"epsilon": 0.002', '"play.gif"': '""', "compared = 40": "compared = 5"}),
}
NUMBER = r"([\d.]+(?:e[+-]?\d+)?)"


def printed(runs, folder):
    """Return the outputs of notebooks with edited parameters, {key: (name, edits)}, by key; images are "<picture>".

    One kernel, started in the folder, runs all notebooks; its variables are deleted before each notebook.
    """
    cells, keys = [], []
    for key, (name, edits) in runs.items():
        notebook = nbformat.read(ROOT / f"notebooks/{name}.ipynb", as_version=4)
        code = [cell for cell in notebook.cells if cell.cell_type == "code"]
        (parameters,) = (cell for cell in code if "parameters" in cell.metadata.get("tags", []))
        for old, new in edits.items():
            assert parameters.source.count(old) == 1, (name, old)
            parameters.source = parameters.source.replace(old, new)
        cells += [nbformat.v4.new_code_cell(source) for source in ("%reset -f", *(cell.source for cell in code))]
        keys += [key] * (len(code) + 1)
    whole = nbformat.v4.new_notebook(cells=cells)
    NotebookClient(whole, kernel_name="python3", resources={"metadata": {"path": str(folder)}}).execute()
    shown = dict.fromkeys(runs, "")
    for key, cell in zip(keys, whole.cells, strict=True):
        for output in cell.outputs:
            data = output.get("data", {"text/plain": output.get("text", "")})
            text = "<picture>" if "image/png" in data else data.get("text/markdown") or data.get("text/plain", "")
            shown[key] += text + "\n"
    return shown


def contents(folder):
    return {path: path.read_bytes() for path in folder.rglob("*") if path.is_file()}


@pytest.fixture(scope="module")
def shown(tmp_path_factory):
    """Return the outputs of RUNS in a folder whose files have the names of results, but no valid content."""
    folder = tmp_path_factory.mktemp("opened")
    for name in ("fixed_points/equal.csv", "simulations/equal/float64/summary.json", "figures/fig10_06.png"):
        for results in (folder / "results", folder / "notebooks/results"):
            (results / name).parent.mkdir(parents=True, exist_ok=True)
            (results / name).write_text("invalid")
    before = contents(folder)
    shown = printed(RUNS, folder / "notebooks")
    assert contents(folder) == before
    return shown


def printed_points(shown):
    """Return the numbers in the printed table of fixed points by label."""
    rows = re.findall(rf"^\d+ +equal +(\w)((?: +-?{NUMBER}){{6}})", shown["points"], re.MULTILINE)
    return {label: [float(value) for value in values.split()] for label, values, *_ in rows}


def test_fixed_points_are_those_of_the_parameters(shown):
    points = vi.fixed_points(system_of("equal", f20_hat=0.72))
    expected = [[*point.C, *point.B, *point.psi] for point in points]
    np.testing.assert_allclose(sorted(printed_points(shown).values()), expected, atol=2e-5)
    assert "fixed points: 3" in shown["points"]
    assert float(re.search(rf"from the table: {NUMBER}", shown["points"])[1]) < 1e-8  # the root by hand


def test_a_system_without_fixed_points_has_a_notebook_that_states_it(shown):
    assert vi.fixed_points(system_of("equal", f20_hat=0.72, kappa=0.3)) == []
    texts = ("fixed points: 0. By (10.26): none", "the theory has no fixed point here", "no fixed point to find.")
    assert [text for text in texts if text not in shown["no points"]] == []


def test_the_response_is_that_of_the_point(shown):
    on_manifold = re.findall(rf"b +[12] +{NUMBER} +{NUMBER}", shown["response"])
    angles = printed_points(shown)["b"][4:]
    phases = re.search(rf"module 1: {NUMBER}, module 2: {NUMBER}", shown["response"]).groups()
    for (C, B), psi, phase in zip(on_manifold, angles, phases, strict=True):
        U = float(B) * np.sin(2 * np.pi * float(phase) - psi)
        assert U + float(C) == pytest.approx(1.0, abs=2e-3)  # W = U + Z at the wall
    assert "**b**: **no orbit**" in shown["response"]  # its orbit vanishes in a fold at 0.732


def test_the_motion_is_that_of_the_parameters(shown):
    text, system = shown["motion"], system_of("equal", f20_hat=0.5)
    largest = [float(re.search(rf"^X{i} +{NUMBER}", text, re.MULTILINE)[1]) for i in (1, 2)]
    np.testing.assert_allclose(largest, vi.ensemble(system, np.zeros(8), 300, settle=295)["largest"], atol=1e-4)
    assert "Ball 2 has no impact in the window" in text
    assert "**repeats every period**" in text
    assert int(re.search(r"changes after one period by up to \$[^$]*10\^\{-(\d+)\}", text)[1]) > 6
    assert not re.search("not repeat|modulated", text)
    rows = re.findall(rf"^(?:time|velocity of \w+ [12]) +-?{NUMBER} +-?{NUMBER}", text, re.MULTILINE)  # an impact
    assert len(rows) == 3
    for by_hand, in_table in rows:
        assert float(by_hand) == pytest.approx(float(in_table), abs=1e-8)


def test_the_manifold_is_that_of_kappa(shown):
    rho = 2 * 0.7 / (np.pi * 1.3)
    border, fold = (float(re.search(rf"{name}.*\) +{NUMBER} ", shown["manifold"])[1]) for name in ("border", "fold"))
    assert border == pytest.approx(4 / (4 + np.pi * rho), abs=1e-6)
    assert fold == pytest.approx(1 / (1 + rho**2), abs=1e-6)
    trace = 2 * 0.3 + np.pi**2 * 1.3**2 * (1 - border) / (4 * border)
    growth = max(abs(np.roots([1, -trace, 0.3**2])))
    assert f"multiplied by **{growth:.2f}**" in shown["manifold"]


def test_every_notebook_shows_its_picture_once(shown):
    assert {key: text.count("<picture>") for key, text in shown.items()} == dict.fromkeys(RUNS, 1)
    assert "fig10_02: printed size 84 mm x 46 mm" in shown["drawing"]


@pytest.mark.thorough
def test_the_notebook_play_shows_correct_results_and_writes_only_the_animation(tmp_path):
    """Numbers of points and orbits are those of the documents; the equal case repeats, the weak case does not."""
    shown = printed(PLAYED, tmp_path)
    assert {key: text.count("<picture>") for key, text in shown.items()} == dict.fromkeys(PLAYED, 3)
    assert all("IPython.core.display.HTML" in text for text in shown.values())
    assert [path.name for path in tmp_path.iterdir()] == ["play.gif"]
    with Image.open(tmp_path / "play.gif") as animation:
        assert animation.n_frames > 30
    equal, weak, sticking, light = shown.values()
    assert "A ball chatters." in sticking
    assert "Fixed points of the theory: 3. Stable ones: c." in equal
    assert "Exact orbits of this kind: 7. Stable ones: 2." in equal
    assert "Fixed points of the theory: 1. Stable ones: none." in weak
    assert "The motion repeats every period." in equal
    assert "The motion does not repeat every period, or not yet." in weak
    assert len(re.findall(r"  symmetric, .*multiplier 0\.\d+$", light, re.MULTILINE)) == 1
    assert not re.search(r"  asymmetric, .*multiplier 0\.\d+$", light, re.MULTILINE)
    differences = {
        text: [float(n) for n in re.search(rf"differ by {NUMBER} after one period and by {NUMBER}", text).groups()]
        for text in (equal, light, weak)
    }
    for text in (equal, light):
        assert max(differences[text]) < 1e-7
        assert re.search(r"^(\d+) impacts by SciPy, \1 events by the library", text, re.MULTILINE)
    assert differences[weak][0] < 1e-8
    assert differences[weak][1] > 0.01  # the motion is chaotic


def test_an_unknown_parameter_of_papermill_is_an_error(tmp_path):
    options = [str(ROOT / "notebooks/fixed_points.ipynb"), "executed.ipynb", "--no-progress-bar", "-p", "kapa", "0.5"]
    run = subprocess.run(
        [sys.executable, "-m", "papermill", *options], cwd=tmp_path, capture_output=True, text=True, check=False
    )
    assert run.returncode != 0
    assert "ValueError: parameters: unknown kapa; this notebook has model, C_max, epsilon, kappa" in run.stderr
