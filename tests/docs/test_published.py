"""Test docs/published.md: functions return the computed numbers, and closed forms give the published numbers."""

import ast
import math
import re
import runpy

import numpy as np
import pytest

from pipeline_trees import ROOT

CODE = ROOT / "docs/published.py"
FUNCTIONS = runpy.run_path(str(CODE))
ROWS = [
    [cell.strip() for cell in line.strip("| ").split(" | ")]
    for line in (ROOT / "docs/published.md").read_text(encoding="utf-8").splitlines()
    if line.startswith("| [")
]
NAMES, LINES = zip(*(re.fullmatch(r"\[(\w+)\]\(published\.py#L(\d+)\)", row[0]).groups() for row in ROWS), strict=True)
MOST_LINES = 8
SAME = "the same"
"""Text in the column "computed" if the numbers equal those in the column "published"."""


def texts(cell):
    """Return the numbers in a cell as they are written."""
    return re.findall(r"-?\d+(?:\.\d+)?", cell.replace("−", "-"))


def test_each_row_has_a_function_of_a_few_lines():
    functions = {node.name: node for node in ast.parse(CODE.read_text(encoding="utf-8")).body if hasattr(node, "args")}
    assert set(NAMES) <= set(functions)
    for name, line in zip(NAMES, LINES, strict=True):
        assert functions[name].lineno == int(line)
        assert functions[name].end_lineno - functions[name].lineno <= MOST_LINES


@pytest.mark.parametrize("row", ROWS, ids=NAMES)
def test_the_function_of_a_row_returns_its_computed_numbers(row):
    shown, values = texts(row[3] if row[4] == SAME else row[4]), FUNCTIONS[NAMES[ROWS.index(row)]]()
    assert [
        f"{float(value):.{len(text.partition('.')[2])}f}" for text, value in zip(shown, values, strict=True)
    ] == shown
    assert (row[4] == SAME) == (row[5] == "agrees")


def test_closed_forms_give_the_published_numbers():
    published = [[float(text) for text in texts(row[3])] for row in ROWS]
    # (66) with M = D = 1: mu D / (1 + mu), mu = m / (m + M); (76) at the values of z for both speeds.
    assert published[1] == [pytest.approx(0.3 / 1.3 / (1 + 0.3 / 1.3), abs=5e-5)] * 2
    for value, V in zip(published[2], (0.5, 2.0), strict=True):
        z = value / V
        assert value == pytest.approx(1 / (1 + 0.3 * math.tan(z) / z), abs=5e-4)
    # The note sets a sum of 11 terms to 1, with p = 0.1 and stiffness 2.
    odd = 2 * np.arange(11) + 1.0
    for omega in published[3]:
        box = 0.8 / (np.pi * omega) / (odd**2 * (odd**2 * omega**2 - 2))
        assert np.pi * 0.1 * 1.3 / 0.3 / (2 * omega) + box.sum() == pytest.approx(1, abs=1e-8)
    # Dux: a quadratic equation.
    cases = [(2, 3.7, 0.8, 0.2, 1), (2, 3.7, 0.8, 0.2, -1), *((n, 2 * n, 0.4, 0.001, 1) for n in (1, 2, 5, 10))]
    for value, (n, omega, r, sigma, sign) in zip(published[5], cases, strict=True):
        T, gamma, loss = 2 * np.pi * n / omega, 1 / (1 - omega**2), (1 - r) / omega
        c = math.sin(T) * (1 + r) / (1 - math.cos(T))
        root = math.sqrt((gamma * c) ** 2 - (sigma**2 - gamma**2) * loss**2)
        assert value == pytest.approx(2 * (sign * root - c * sigma) / (c**2 + loss**2), abs=5.1e-6)
    # CC: amplitudes of the frequency response at the clearance 0.3, and the largest clearance on the backbone curve.
    rho, D, a = 2 / np.pi * 0.2 / 1.8, 1e-3, 0.02
    xi = np.geomspace(1.00001 * rho / math.hypot(1, rho), 100, 1_000_000)
    theta = (1 + np.sqrt((1 + rho**2) * xi**2 - rho**2)) / (1 + rho**2)
    lag = np.arccos((theta - 1) / xi)

    def width(r):
        """Return the clearance at which the motion (xi, theta) has the frequency ratio r."""
        stiff = (1 - (1 - a) * r**2 + 2j * D * r) * xi - 8 * a * theta * r**2 * np.exp(-1j * lag) / np.pi**2
        return 2 * D / abs(stiff)

    for value, r in zip(published[7], (0.98, 0.9885, 0.99, 0.992), strict=True):
        assert value == pytest.approx(theta[np.flatnonzero(np.diff(np.sign(width(r) - 0.3)))[-1]], abs=5.1e-5)
    backbone = np.sqrt(xi / ((1 - a) * xi + 8 * a * theta * np.cos(lag) / np.pi**2))
    widest = width(backbone)
    assert published[9] == [pytest.approx(widest.max(), abs=5e-5)]
    assert backbone[widest.argmax()] == pytest.approx(0.98846, abs=5e-6)
    # Flights above a floor of a spring whose equilibrium is at depth d below the floor, and the sum of their durations.
    omega, d = math.sqrt(1e5), 9.81e-5
    steep = math.sqrt((1 + d) ** 2 - d**2) / d
    flights = 2 * np.arctan(0.9 ** np.arange(1, 400) * steep) / omega
    times = np.concatenate([[0], flights.cumsum()]) + math.acos(d / (1 + d)) / omega
    assert published[11][:-1] == pytest.approx(times[[0, 1, 9, 49, 99, 149]], abs=5.1e-8)
    assert published[11][-1] == pytest.approx(times[-1], abs=5.1e-7)
