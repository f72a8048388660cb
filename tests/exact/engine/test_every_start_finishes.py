"""Every admissible start finishes: none hangs or raises, and its table of events is in order.

`python tests/shared/hard_starts.py 20000` draws more of the random ones.
"""

import subprocess
import sys

import numpy as np
import pytest

import vibroimpact as vi
from hard_starts import departures, faults
from vibroimpact.accuracy.reference.run import reference_run
from vibroimpact.system.state import IMPACT, STICK

ALONE = dict(alpha12_hat=0.0, gamma12_hat=0.0, f20_hat=0.0)
ALMOST_ALONE = dict(ALONE, alpha12_hat=1e-20)
PAIRED = dict(
    epsilon=0.5, kappa=0.01, alpha12_hat=2, gamma1_hat=0, gamma2_hat=0.2, gamma12_hat=0.2, sigma20_hat=0,
    sigma_e_hat=0.2, f10_hat=2, f20_hat=0,
)  # fmt: skip
LONG = dict(kappa=0.9, alpha12_hat=0, sigma_e_hat=-2.5, f10_hat=2, f20_hat=0)
HARD = {
    # changes of the chapter's system, start, tau0
    "a slow ball next to a driven module": (ALONE, [0, 0, 0, -1, 0, 0, 0, -1e-50], 0.0),
    "a slower one": (ALONE, [0, 0, 0, -1, 0, 0, 0, -1e-300], 0.0),
    "a box hardly out of rest": (ALONE, [0, 0, 1e-60, -1, 0, 0, 0, 0], 0.0),
    "a slow ball, hardly driven": (ALMOST_ALONE, [0, 0, 0, -1, 0, 0, 0, -1e-50], 0.0),
    "at rest but for rounding": (PAIRED, [2, 2.999999999, 1, 2, 0, 1e-16, 0, 1e-9], 1.427996660722633),
    "long chatter, slow ball": (LONG, [2, 2, 0, 1, 0, -1e-9, 0, -1e-30], 4.1887902047863905),
    "long chatter, slow ball, uncoupled": (LONG | ALONE, [2, 2, 0, 1, 0, -1e-9, 0, -1e-30], 4.1887902047863905),
    "two on their walls": (dict(kappa=0.1), [-0.5, -1.5, -0.5, -1.5, 0, 0, 0, -1e-5], 0.0),
}


@pytest.mark.parametrize(("changes", "start", "tau0"), HARD.values(), ids=HARD)
def test_a_hard_start_finishes_with_the_motion_of_the_reference(chapter, changes, start, tau0):
    """Velocities too small to matter are none in the reference, which would follow them for long."""
    system = chapter(**changes)
    run = vi.simulate(system, start, 1, tau0)
    assert run.certificate.exclusions < 100
    assert (np.diff(run.events["tau"]) >= 0.0).all()
    assert max(departures(run)) < 1e-12  # a chatter that is completed: the way of its box until then
    truth = reference_run(system, [x if abs(x) > 1e-12 else 0 for x in start], 1, 80, tau0)
    np.testing.assert_allclose(run.final, truth.final, rtol=0, atol=1e-14)


@pytest.mark.parametrize("kappa", [1e-300, 1e-17, 1e-16, 2e-16, 1e-15])
@pytest.mark.parametrize("seed", range(8))
def test_a_rebound_that_is_rounding_is_none(chapter, kappa, seed):
    rng = np.random.default_rng(seed)
    start = np.round([*rng.uniform(-1, 1, 4), *rng.uniform(-1, 1, 4)], 3)
    start[[1, 3]] = np.round(start[[0, 2]] - rng.uniform(-1, 1, 2), 3)
    run = vi.simulate(chapter(1.0, 0.7, kappa=kappa), start, 3)
    truth = reference_run(chapter(1.0, 0.7, kappa=1e-40), start, 3, 60)
    np.testing.assert_allclose(run.final, truth.final, rtol=0, atol=1e-13)
    assert len(run.events) > 2
    for event in run.events[run.events["kind"] == IMPACT]:
        box, ball = event["state"][[2 + 2 * event["module"], 3 + 2 * event["module"]]]
        assert abs(box - ball) < 1e-14
    assert STICK in run.events["kind"]


@pytest.mark.parametrize("number", range(120))
def test_random_hard_starts(number):
    assert list(faults(number)) == []


def test_a_run_with_too_many_exclusions_is_given_up():
    """In the interpreter, where the limits can be changed."""
    program = """
import vibroimpact as vi
from chapter import PARAMETERS
from vibroimpact.exact.engine import event_loop as events, flow, flow_tables, phase
phase.fused = flow_tables.fused = lambda a, b, c: a * b + c  # what only compiled code can do
flow.to_fixed_tuple = lambda array, length: tuple(array)
flow.weighted_sum = lambda table, mode, j, weights: (weights @ table[mode, j]).reshape(2, 8)
events.MOST_PROOFS = events.MOST_PROOFS_PER_EVENT = events.MOST_PROOFS_PER_UNIT = 0
vi.simulate(vi.System(**PARAMETERS, f10_hat=1, f20_hat=1), [0] * 8, 3)
"""
    environment = {"NUMBA_DISABLE_JIT": "1", "PYTHONPATH": ":".join(sys.path)}
    run = subprocess.run([sys.executable, "-c", program], env=environment, capture_output=True, text=True, check=False)
    assert "ArithmeticError: there are too many exclusions after" in run.stderr
