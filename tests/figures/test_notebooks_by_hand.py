"""Notebooks with parameters that a reader has changed: what they say follows from these, and no file is written."""

import re
import subprocess
import sys

import numpy as np
import pytest
from nbclient.exceptions import CellExecutionError
from PIL import Image
from scipy.integrate import solve_ivp
from scipy.optimize import fsolve

from by_hand import BoxesByHand
from chapter import PARAMETERS
from opened_notebooks import printed
from pipeline_trees import ROOT
from vibroimpact.system import System

LESS = {"f20_hat = 1.0": "f20_hat = 0.72"}
RUNS = {
    "points": ("fixed_points", LESS),
    "no points": ("fixed_points", LESS | {"kappa = 0.65": "kappa = 0.3"}),
    "response": ("theoretical_response", LESS | {'fixed_point = "c"': 'fixed_point = "b"'}),
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


def sums(folder):
    return {path: path.read_bytes() for path in folder.rglob("*") if path.is_file()}


@pytest.fixture(scope="module")
def shown(tmp_path_factory):
    """What each of RUNS shows, opened beside files that bear the names of results and hold nothing of use."""
    folder = tmp_path_factory.mktemp("opened")
    for name in ("fixed_points/equal.csv", "simulations/equal/float64/summary.json", "figures/fig10_06.png"):
        for results in (folder / "results", folder / "notebooks/results"):
            (results / name).parent.mkdir(parents=True, exist_ok=True)
            (results / name).write_text("of a build")
    before = sums(folder)
    shown = printed(RUNS, folder / "notebooks")
    assert sums(folder) == before
    return shown


def balance(unknowns, kappa, forces):
    """First harmonic of the boxes' equations at leading order, and the manifold left out: (C1, C2, psi1, psi2).

    -2 sigma_e a_i + i gamma_i a_i + coupling + 8 i C_i / pi^2 e^(-i (psi_i + eta_i)) = f_i for U_i = Im a_i e^(i tau).
    """
    C, psi = np.array(unknowns[:2]), np.array(unknowns[2:])
    rho = 2 * (1 - kappa) / (np.pi * (1 + kappa))
    at_impact = rho * C + 1j * (1 - C)  # B e^(i eta), (10.17)
    a = abs(at_impact) * np.exp(-1j * psi)
    linear = -2 * 0.2 + 0.2j + np.array([0.0, 0.5])
    tooth = 8j * C / np.pi**2 * np.exp(-1j * (psi + np.angle(at_impact)))
    return linear * a + (1.0 + 0.2j) * (a - a[::-1]) + tooth - forces


def solutions(kappa, forces):
    """C of all solutions of `balance` with C > 0 that Newton's method finds from many starts."""
    found, random = set(), np.random.default_rng(1)
    for start in random.uniform([0, 0, -np.pi, -np.pi], [3, 3, np.pi, np.pi], (400, 4)):

        def both(x):
            left = balance(x, kappa, forces)
            return [*left.real, *left.imag]

        x, _, status, _ = fsolve(both, start, full_output=True)
        if status == 1 and np.abs(both(x)).max() < 1e-9 and min(x[:2]) > 0:
            found.add(tuple(x[:2].round(5)))
    return sorted(found)


def table_of(text, columns):
    """Numbers in the rows of a printed table with the labels a, b, ..."""
    rows = re.findall(rf"^\d+ +equal +(\w)((?: +-?{NUMBER}){{{columns}}})", text, re.MULTILINE)
    return {label: [float(value) for value in values.split()] for label, values, *_ in rows}


def test_fixed_points_are_those_of_the_parameters(shown):
    expected = solutions(0.65, [1.0, 0.72])
    table = table_of(shown["points"], 6)
    assert len(expected) == 3
    assert "fixed points: 3" in shown["points"]
    np.testing.assert_allclose(sorted(row[:2] for row in table.values()), expected, atol=2e-5)
    for C1, C2, B1, B2, psi1, psi2 in table.values():
        assert abs(balance([C1, C2, psi1, psi2], 0.65, [1.0, 0.72])).max() < 1e-5
        assert pytest.approx([abs(0.1350453 * C + 1j * (1 - C)) for C in (C1, C2)], abs=1e-5) == [B1, B2]


def test_without_a_fixed_point_none_is_shown(shown):
    assert solutions(0.3, [1.0, 0.72]) == []
    assert "fixed points: 0. By (10.26): none" in shown["no points"]
    assert "the theory has no fixed point here" in shown["no points"]


def test_the_response_is_that_of_the_point(shown):
    on_manifold = re.findall(rf"b +[12] +{NUMBER} +{NUMBER}", shown["response"])
    angles = table_of(shown["points"], 6)["b"][4:]
    phases = re.search(rf"module 1: {NUMBER}, module 2: {NUMBER}", shown["response"]).groups()
    for (C, B), psi, phase in zip(on_manifold, angles, phases, strict=True):
        U = float(B) * np.sin(2 * np.pi * float(phase) - psi)
        assert U + float(C) == pytest.approx(1.0, abs=2e-3)  # W = U + Z at the wall
    assert "**b**: **no orbit**" in shown["response"]  # lost in a fold at 0.732


def amplitudes(forces, cycles=300):
    """Amplitudes of the boxes from rest, integrated from impact to impact by SciPy; ball 2 stays where it is."""
    system = System(**PARAMETERS, f10_hat=forces[0], f20_hat=forces[1])
    boxes = BoxesByHand(system)
    rate, period = boxes.rate([False, False]), 2 * np.pi / boxes.omega

    def motion(tau, state):  # X1, X2, X1', X2', sin, cos, Y1, Y1'
        return [*(rate @ state[:6]), state[7], 0.0]

    def wall(tau, state):
        return 1 - abs(state[0] - state[6])

    wall.terminal, wall.direction = True, -1
    tau, state, end, seen = 0.0, np.array([0, 0, 0, 0, 0, 1.0, 0, 0]), cycles * period, [np.zeros(2)]
    while tau < end:
        last = tau > end - 5 * period
        run = solve_ivp(
            motion,
            (tau, end),
            state,
            "DOP853",
            rtol=1e-9,
            atol=1e-11,
            events=wall,
            max_step=period / 8,
            dense_output=last,
        )
        if last:
            seen.append(abs(run.sol(np.linspace(tau, run.t[-1], 500))[:2]).max(axis=1))
        tau, state = run.t[-1], run.y[:, -1].copy()
        box, ball = state[2], state[7]
        state[2] = (box + system.epsilon * (ball - system.kappa * (box - ball))) / (1 + system.epsilon)
        state[7] = state[2] + system.kappa * (box - ball)
        state[6] = state[0] - np.sign(state[0] - state[6]) * (1 - 1e-12)
    assert abs(state[1]) < 1
    return np.max(seen, axis=0)


def test_the_motion_is_that_of_the_parameters(shown):
    text = shown["motion"]
    said = [float(re.search(rf"^X{i} +{NUMBER}", text, re.MULTILINE)[1]) for i in (1, 2)]
    np.testing.assert_allclose(said, amplitudes([1.0, 0.5]), atol=1e-4)
    assert "Ball 2 has no impact in the window" in text
    assert "**repeats every period**" in text
    assert float(re.search(f"changes after one period by up to {NUMBER}", text)[1]) < 1e-6
    assert "not repeat" not in text
    assert "modulated" not in text


def test_the_manifold_is_that_of_kappa(shown):
    rho = 2 * 0.7 / (np.pi * 1.3)
    border, fold = (float(re.search(rf"{name}.*\) +{NUMBER} ", shown["manifold"])[1]) for name in ("border", "fold"))
    assert border == pytest.approx(4 / (4 + np.pi * rho), abs=1e-6)
    assert fold == pytest.approx(1 / (1 + rho**2), abs=1e-6)
    trace = 2 * 0.3 + np.pi**2 * 1.3**2 * (1 - border) / (4 * border)
    growth = max(abs(np.roots([1, -trace, 0.3**2])))
    assert f"multiplied by **{growth:.2f}**" in shown["manifold"]


def test_another_drawing_is_that_drawing(shown):
    assert "fig10_02: printed size 84 mm x 46 mm" in shown["drawing"]


def test_every_notebook_shows_its_picture_once(shown):
    assert {key: text.count("<picture>") for key, text in shown.items()} == dict.fromkeys(RUNS, 1)


def test_the_root_by_hand_is_that_of_the_table(shown):
    assert float(re.search(rf"from the table: {NUMBER}", shown["points"])[1]) < 1e-8
    assert "There is no fixed point to find." in shown["no points"]


def test_the_impact_by_hand_is_that_of_the_table(shown):
    rows = re.findall(rf"^(?:time|velocity of \w+ [12]) +-?{NUMBER} +-?{NUMBER}", shown["motion"], re.MULTILINE)
    assert len(rows) == 3
    for by_hand, in_the_table in rows:
        assert float(by_hand) == pytest.approx(float(in_the_table), abs=1e-8)


@pytest.fixture(scope="module")
def played(tmp_path_factory):
    """What the notebook to play with shows, and the folder it was started in."""
    folder = tmp_path_factory.mktemp("play")
    return printed(PLAYED, folder), folder


def test_playing_shows_motion_section_and_comparison_and_writes_the_animation_alone(played):
    shown, folder = played
    assert {key: text.count("<picture>") for key, text in shown.items()} == dict.fromkeys(PLAYED, 3)
    assert [path.name for path in folder.iterdir()] == ["play.gif"]
    with Image.open(folder / "play.gif") as animation:
        assert animation.n_frames > 30
    assert all("IPython.core.display.HTML" in text for text in shown.values())


def test_playing_tells_the_truth(played):
    """Numbers of points and orbits as in the documents; the motion of the equal case repeats, the weak one does not."""
    equal, weak, sticking, light = (played[0][key] for key in PLAYED)
    assert "A ball chatters." in sticking
    assert "Fixed points of the theory: 3. Stable ones: c." in equal
    assert "Exact orbits of this kind: 7. Stable ones: 2." in equal
    assert "Fixed points of the theory: 1. Stable ones: none." in weak
    assert "The motion repeats every period." in equal
    assert "The motion does not repeat every period, or not yet." in weak
    assert len(re.findall(r"  symmetric, .*multiplier 0\.\d+$", light, re.MULTILINE)) == 1
    assert not re.search(r"  asymmetric, .*multiplier 0\.\d+$", light, re.MULTILINE)


def test_scipy_written_out_agrees_until_chaos_parts_it(played):
    def apart(text):
        return [float(n) for n in re.search(rf"differ by {NUMBER} after one period and by {NUMBER}", text).groups()]

    equal, weak, _, light = (played[0][key] for key in PLAYED)
    for text in (equal, light):
        assert max(apart(text)) < 1e-7
        assert re.search(r"^(\d+) impacts by SciPy, \1 events by the library", text, re.MULTILINE)
    assert apart(weak)[0] < 1e-8
    assert apart(weak)[1] > 0.01


def papermill(folder, *arguments):
    """Exit status and output of papermill on the notebook of fixed points, and what the executed one shows."""
    notebook = folder / "executed.ipynb"
    given = [str(ROOT / "notebooks/fixed_points.ipynb"), str(notebook), "--no-progress-bar", *arguments]
    done = subprocess.run(
        [sys.executable, "-m", "papermill", *given], cwd=folder, capture_output=True, text=True, check=False
    )
    return done, notebook.read_text(encoding="utf-8")


def test_papermill_sets_a_parameter_by_its_name(tmp_path):
    done, executed = papermill(tmp_path, "-p", "kappa", "0.5", "-p", "f20_hat", "0.9")
    assert done.returncode == 0, done.stderr
    expected = solutions(0.5, [1.0, 0.9])
    assert expected
    assert expected != solutions(0.65, [1.0, 0.9])
    table = re.findall(rf"^ *\"\d+ +equal +\w +{NUMBER} +{NUMBER}", executed, re.MULTILINE)
    np.testing.assert_allclose(sorted([float(C1), float(C2)] for C1, C2 in table), expected, atol=2e-5)


def test_papermill_is_refused_a_parameter_that_the_notebook_has_not(tmp_path):
    done, _ = papermill(tmp_path, "-p", "kapa", "0.5")
    assert done.returncode != 0
    assert "ValueError: parameters: unknown kapa; this notebook has model, C_max, epsilon, kappa" in done.stderr


def test_a_reader_is_refused_it_too(tmp_path):
    with pytest.raises(CellExecutionError, match="parameters: unknown kapa; this notebook has model, C_max"):
        printed({"typo": ("fixed_points", {"kappa = 0.65": "kappa = 0.65\nkapa = 0.5"})}, tmp_path)
