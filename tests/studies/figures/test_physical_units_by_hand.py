"""The notebook of machines with parameters that a reader has changed."""

import re

import numpy as np
import pytest

from opened_notebooks import printed

CHANGES = {"k12 = 100.0": "k12 = 300.0", '"values": 13': '"values": 3'}


@pytest.mark.thorough
def test_machines_swing_as_their_springs_have_it(tmp_path):
    omega = 2 * np.pi * np.linspace(2.9, 3.5, 20001)
    K = np.array([[4300.0, -300.0], [-300.0, 4400.0]])
    C = np.array([[6.0, -2.0], [-2.0, 6.0]])
    left = K - omega[:, None, None] ** 2 * 10.0 * np.eye(2) + 1j * omega[:, None, None] * C
    swing = 1000 * abs(np.linalg.solve(left, np.full((len(omega), 2, 1), 2.0))).max()
    shown = printed({"machines": ("studies/physical_units", CHANGES)}, tmp_path)["machines"]
    said = re.search(r"The peak amplitude is \*\*([\d.]+) mm", shown)[1]
    assert float(said) == pytest.approx(swing, abs=0.1)
    assert shown.count("<picture>") == 1
    assert list(tmp_path.iterdir()) == []
