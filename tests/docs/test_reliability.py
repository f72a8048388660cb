"""Test the numbers of docs/engine.md: they equal constants of the tests, or the test measures them.

The tests of the studies test statements on proofs, with the results of a build.
"""

import re

import numpy as np
import pytest

import vibroimpact as vi
from chapter import FORCES, PARAMETERS
from pipeline_trees import ROOT

PAGE = (ROOT / "docs/engine.md").read_text(encoding="utf-8")
STRESS_TESTS = (ROOT / "tests/shared/attacks.py").read_text(encoding="utf-8")


def test_the_stated_bound_of_the_error_is_that_of_the_stress_tests():
    bound = re.search(r"at most ([\d.]+) times this estimate", PAGE)[1]
    assert bound == re.search(r"^MAX_ERROR_RATIO = ([\d.]+)", STRESS_TESTS, re.MULTILINE)[1]
    worst = re.search(r"at worst ([\d.]+) times in ([\d ]+) runs", PAGE)[1]
    assert float(worst) < float(bound)


def test_the_stated_horizon_of_the_modulated_response_is_that_of_runs():
    system = vi.System(**PARAMETERS, **dict(zip(("f10_hat", "f20_hat"), FORCES["weak"], strict=True)))
    random, cycles = np.random.default_rng(1), []
    for _ in range(15):
        settled = vi.simulate(system, [0.0] * 4 + random.uniform(-0.5, 0.5, 4).tolist(), 300)
        run = vi.simulate(system, settled.final, 120, tau0=settled.end)
        assert not run.certificate.decided
        cycles.append((run.certificate.horizon - run.tau0) / system.period)
    stated = float(re.search(r"some (\d+) cycles", PAGE)[1])
    assert np.median(cycles) == pytest.approx(stated, rel=0.15)


def test_certificates_have_the_fields_that_the_page_names():
    certificate = vi.simulate(vi.System(**PARAMETERS, f10_hat=1.0, f20_hat=1.0), [0.0] * 8, 5).certificate
    for name in re.findall(r"`certificate\.(\w+)`", PAGE):
        assert hasattr(certificate, name)
