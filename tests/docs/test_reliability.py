"""Test the numbers that docs/engine.md states: they equal constants in the tests, or are measured again.

Statements on proofs are tested with the results of a build, in the tests of the studies.
"""

import re

import numpy as np
import pytest

import vibroimpact as vi
from chapter import FORCES, PARAMETERS
from pipeline_trees import ROOT

PAGE = (ROOT / "docs/engine.md").read_text(encoding="utf-8")
ATTACK = (ROOT / "tests/shared/attacks.py").read_text(encoding="utf-8")


def test_the_promised_error_is_that_which_is_attacked():
    promised = re.search(r"at most ([\d.]+) times this estimate", PAGE)[1]
    assert promised == re.search(r"^MAX_ERROR_RATIO = ([\d.]+)", ATTACK, re.MULTILINE)[1]
    worst = re.search(r"at worst ([\d.]+) times in ([\d ]+) runs", PAGE)[1]
    assert float(worst) < float(promised)


def test_the_horizon_of_the_modulated_response():
    system = vi.System(**PARAMETERS, **dict(zip(("f10_hat", "f20_hat"), FORCES["weak"], strict=True)))
    random, cycles = np.random.default_rng(1), []
    for _ in range(15):
        settled = vi.simulate(system, [0.0] * 4 + random.uniform(-0.5, 0.5, 4).tolist(), 300)
        run = vi.simulate(system, settled.final, 120, tau0=settled.end)
        assert not run.certificate.decided
        cycles.append((run.certificate.horizon - run.tau0) / system.period)
    said = float(re.search(r"some (\d+) cycles", PAGE)[1])
    assert np.median(cycles) == pytest.approx(said, rel=0.15)


def test_the_fields_it_names_are_there():
    certificate = vi.simulate(vi.System(**PARAMETERS, f10_hat=1.0, f20_hat=1.0), [0.0] * 8, 5).certificate
    for name in re.findall(r"`certificate\.(\w+)`", PAGE):
        assert hasattr(certificate, name)
