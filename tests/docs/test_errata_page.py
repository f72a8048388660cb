"""Compute the numbers that docs/errata.md states on fixed points."""

import re

import numpy as np
import pytest

import vibroimpact as vi
from chapter import FORCES, PARAMETERS
from pipeline_trees import ROOT

PAGE = (ROOT / "docs/errata.md").read_text(encoding="utf-8").replace("−", "-").replace("**", "")
ROWS = re.findall(r"^\| (\w+), ([abc]) \| ([\d.]+), ([\d.]+) \| (.*) \|$", PAGE, re.MULTILINE)
POINTS = {
    (case, point.label): point
    for case, (f10, f20) in FORCES.items()
    for point in vi.fixed_points(vi.System(**PARAMETERS, f10_hat=f10, f20_hat=f20))
}


def test_the_table_has_a_row_for_each_fixed_point():
    assert {(case, label) for case, label, *_ in ROWS} == set(POINTS)


@pytest.mark.parametrize("row", ROWS, ids=lambda row: "".join(row[:2]))
def test_a_row_has_the_amplitudes_and_slow_eigenvalues_of_its_point(row):
    case, label, C1, C2, eigenvalues = row
    point = POINTS[case, label]
    np.testing.assert_allclose(point.C, [float(C1), float(C2)], atol=5.01e-6)
    stated = []
    for text in eigenvalues.split(", "):
        real, _, imaginary = text.removesuffix("i").partition(" ± ")
        stated += [complex(float(real), sign * float(imaginary)) for sign in (1, -1)] if imaginary else [float(real)]
    rounded = np.sort_complex(point.slow_eigenvalues.round(4))
    np.testing.assert_allclose(np.sort_complex(np.array(stated, complex)), rounded, atol=1.01e-4)


def test_distance_of_point_b_of_the_unequal_case_from_the_fold():
    rho = 2 * (1 - PARAMETERS["kappa"]) / (np.pi * (1 + PARAMETERS["kappa"]))
    share = 100 * (1 - POINTS["unequal", "b"].C[0] * (1 + rho**2))
    assert f"{share:.1f} % below the fold" in PAGE
