"""The error estimate and the horizon of a certificate agree with measured errors."""

import numpy as np
import pytest

import vibroimpact as vi
from chapter import PARAMETERS
from vibroimpact.accuracy.reference.run import proven_run
from vibroimpact.studies.horizon import departure

WEAK = vi.System(**PARAMETERS, f10_hat=0.5, f20_hat=0.5)
START = [0.0, 0.0, 0.0, 0.0, 0.0, 0.5, 0.0, 0.5]
CYCLES = 60


@pytest.fixture(scope="module")
def truth():
    """Return the states of a proven run after each cycle."""
    return proven_run(WEAK, START, CYCLES, sample_times=np.arange(CYCLES + 1) * WEAK.period).run.samples


def test_error_estimate_and_horizon_agree_with_measured_errors(truth):
    difference, expected, horizon = departure(WEAK, START, truth)
    known = np.flatnonzero(np.isfinite(expected))[2:]
    ratio = difference[known] / expected[known]
    assert ratio.min() > 1e-3
    assert ratio.max() < 10
    # The error is below 1e-3 until shortly before the horizon, and exceeds 1e-3 shortly after it.
    assert 30 < horizon < 50
    assert difference[: int(horizon) - 5].max() < 1e-3 < difference[int(horizon) : int(horizon) + 12].max()
    assert np.isinf(expected[int(horizon) + 1 :]).all()
