"""Every admissible start leads to the motion of the reference, or to an error that gives the reason."""

from fractions import Fraction

import numpy as np
import pytest

import vibroimpact as vi
from attacks import rebound_speeds
from hard_starts import departures
from programs import run_program
from vibroimpact.accuracy.reference.run import reference_run
from vibroimpact.system.state import IMPACT, STICK

UNCOUPLED = dict(alpha12_hat=0.0, gamma12_hat=0.0)
ONE = dict(f20_hat=0.0)
ALONE = UNCOUPLED | ONE
PAIRED = dict(
    epsilon=0.5, kappa=0.01, alpha12_hat=2, gamma1_hat=0, gamma2_hat=0.2, gamma12_hat=0.2, sigma20_hat=0,
    sigma_e_hat=0.2, f10_hat=2, f20_hat=0,
)  # fmt: skip
LONG = dict(kappa=0.9, alpha12_hat=0, sigma_e_hat=-2.5, f10_hat=2, f20_hat=0)
HARD = {
    # changes of the chapter's system, start, tau0
    "a slow ball next to a driven module": (ALONE, [0, 0, 0, -1, 0, 0, 0, -1e-300], 0.0),
    "a box almost at rest": (ALONE, [0, 0, 1e-60, -1, 0, 0, 0, 0], 0.0),
    "a slow ball, almost undriven": (ALONE | dict(alpha12_hat=1e-20), [0, 0, 0, -1, 0, 0, 0, -1e-50], 0.0),
    "at rest within rounding": (PAIRED, [2, 2.999999999, 1, 2, 0, 1e-16, 0, 1e-9], 1.427996660722633),
    "long chatter, slow ball": (LONG, [2, 2, 0, 1, 0, -1e-9, 0, -1e-30], 4.1887902047863905),
    "two on their walls": (dict(kappa=0.1), [-0.5, -1.5, -0.5, -1.5, 0, 0, 0, -1e-5], 0.0),
    "nothing moves": (dict(f10_hat=0.0, f20_hat=0.0), [0, 1, 0, 0, 0, 0, 0, 0], 0.0),
    "ball of an undriven module on a wall": (ONE, [0, 0, 0, 1, 0, 0, 0, 0], 0.0),
    "coupled by a spring alone": (ONE | dict(gamma12_hat=0.0), [0, 0, 0, 1, 0, 0, 0, 0], 0.0),
    "coupled by a damper alone": (ONE | dict(alpha12_hat=0.0), [0, 0, 0, -1, 0, 0, 0, 0], 0.0),
    "uncoupled": (ALONE, [0, 0, 0, -1, 0, 0, 0, 0], 0.0),
    "undamped resonance of a box with its ball": (
        ALONE | dict(f10_hat=0.3, gamma1_hat=0, gamma2_hat=0, sigma_e_hat=10 * (1.1**-0.5 - 1)),
        [-2, -3, 0, 0, 0, 0, 0, 0], 0.0,
    ),
}  # fmt: skip


@pytest.mark.parametrize(("changes", "start", "tau0"), HARD.values(), ids=HARD)
def test_a_hard_start_leads_to_the_final_state_of_the_reference(chapter, changes, start, tau0):
    """Components below 1e-12 are 0 in the reference, which would otherwise compute very long chatters."""
    system = chapter(**changes)
    run = vi.simulate(system, start, 1, tau0)
    assert run.certificate.exclusions < 100
    assert (np.diff(run.events["tau"]) >= 0.0).all()
    assert max(departures(run)) < 1e-12  # the displacement of a box until a chatter is completed
    truth = reference_run(system, [x if abs(x) > 1e-12 else 0 for x in start], 1, 80, tau0)
    np.testing.assert_allclose(run.final, truth.final, rtol=0, atol=1e-14)


@pytest.mark.parametrize("kappa", [1e-300, 1e-16, 1e-15])
@pytest.mark.parametrize("seed", range(4))
def test_a_rebound_within_rounding_counts_as_no_rebound(chapter, kappa, seed):
    rng = np.random.default_rng(seed)
    start = np.round([*rng.uniform(-1, 1, 4), *rng.uniform(-1, 1, 4)], 3)
    start[[1, 3]] = np.round(start[[0, 2]] - rng.uniform(-1, 1, 2), 3)
    run = vi.simulate(chapter(1.0, 0.7, kappa=kappa), start, 3)
    truth = reference_run(chapter(1.0, 0.7, kappa=1e-40), start, 3, 60)
    np.testing.assert_allclose(run.final, truth.final, rtol=0, atol=1e-13)
    assert STICK in run.events["kind"]
    assert rebound_speeds(run.events[run.events["kind"] == IMPACT]).max(initial=0.0) < 1e-14


@pytest.mark.parametrize("position", [1.0, 1.0 - 2**-52, 1.0 + 2**-52])
@pytest.mark.parametrize("ball", [0.0, 2.0])
def test_a_contact_force_that_is_zero_at_the_start_only(chapter, position, ball):
    changes = dict(epsilon=1.0, gamma1_hat=0.0, gamma2_hat=0.0, sigma20_hat=0.0, sigma_e_hat=0.25)
    system = chapter(1.0, 0.0, **UNCOUPLED, **changes)
    start = [position, ball + position - 1.0, 0, 0, 0, 0, 0, 0]
    run = vi.simulate(system, start, 1, tau0=system.period / 4)
    assert len(run.events) < 200
    wall = 1 if ball == 0.0 else -1
    start[:2] = Fraction(position), Fraction(position) - wall  # the engine places the ball exactly on the wall
    truth = reference_run(system, start, 1, 80, tau0=system.period / 4)
    np.testing.assert_allclose(run.final, truth.final, rtol=0, atol=1e-13)


SYMMETRIC = {
    # changes, start, cycles
    "in phase": (
        dict(
            epsilon=0.8927, kappa=0.8101, alpha12_hat=2.678, gamma12_hat=1.7393, gamma1_hat=0.8381, gamma2_hat=0.8381,
            sigma_e_hat=0.6698, f10_hat=-0.1113, f20_hat=-0.1113,
        ), [0.388, -0.611999999, 0.388, -0.611999999, -0.529, -0.52901, -0.529, -0.52901], 3,
    ),
    "in antiphase": (
        dict(
            epsilon=0.0917, kappa=0.9442, alpha12_hat=0.8535, gamma12_hat=1.0418, gamma1_hat=0.68, gamma2_hat=0.68,
            sigma_e_hat=46.3728, f10_hat=1.9352, f20_hat=-1.9352,
        ), [-0.2794, -1.27939999999, 0.2794, 1.27939999999, 0.6108, 0.6098, -0.6108, -0.6098], 8,
    ),
}  # fmt: skip


@pytest.mark.parametrize(("changes", "start", "cycles"), SYMMETRIC.values(), ids=SYMMETRIC)
def test_chatters_of_symmetric_modules_end_at_the_same_time(chapter, changes, start, cycles):
    system = chapter(**changes, sigma20_hat=0.0)
    run, truth = vi.simulate(system, start, cycles), reference_run(system, start, cycles, 40)
    np.testing.assert_allclose(run.final, truth.final, rtol=0, atol=1e-13)
    assert run.certificate.decided
    for module in (1, 2):
        events = (one.events[(one.events["module"] == module) & (one.events["kind"] == STICK)] for one in (truth, run))
        early = np.subtract(*(one["tau"] for one in events))  # docs/engine.md, coincident events
        assert early.min() > -1e-9
        assert early.max() < 2e-5


@pytest.mark.parametrize("sigma_e_hat", [0.2, 50.0], ids=["in a lane", "alone"])
def test_a_chatter_with_too_many_impacts_is_an_error(chapter, sigma_e_hat):
    system = chapter(0.0, 0.0, **UNCOUPLED, kappa=1 - 1e-9, sigma_e_hat=sigma_e_hat)
    start = [-1.5, -2.5, 0, 0, 0, 1e-7, 0, 0]
    with pytest.raises(ArithmeticError, match="there are too many events"):
        vi.simulate(system, start, 1)
    assert vi.STATUSES[int(vi.ensemble(system, start, 1)["status"])] == "there are too many events"


TOO_MANY_PROOFS = """
import vibroimpact as vi
from chapter import system_of
from vibroimpact.exact.engine import event_loop as events, flow, flow_tables
flow.fused = flow_tables.fused = lambda a, b, c: a * b + c  # replaces intrinsics of compiled code
flow.to_fixed_tuple = lambda array, length: tuple(array)
flow.weighted_sum = lambda table, mode, j, weights: (weights @ table[mode, j]).reshape(2, 8)
events.MOST_PROOFS = events.MOST_PROOFS_PER_EVENT = events.MOST_PROOFS_PER_UNIT = 0
vi.simulate(system_of("equal"), [0] * 8, 3)
"""


def test_a_run_with_too_many_proofs_is_an_error():
    """The program runs without compilation, so that it can change the limits."""
    run = run_program(TOO_MANY_PROOFS, NUMBA_DISABLE_JIT="1")
    assert "ArithmeticError: there are too many proofs that no event happens: stopped after" in run.stderr
