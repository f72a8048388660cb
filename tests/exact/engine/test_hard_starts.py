"""Starts and runs that once stalled, ran away or were certified wrongly."""

from fractions import Fraction

import numpy as np
import pytest

import vibroimpact as vi
from vibroimpact.accuracy.reference.run import reference_run
from vibroimpact.system.state import STICK

UNCOUPLED = dict(alpha12_hat=0.0, gamma12_hat=0.0)
REST = {
    "nothing moves": ((0.0, 0.0), {}, [0, 1, 0, 0, 0, 0, 0, 0]),
    "ball of an undriven module on a wall": ((1.0, 0.0), {}, [0, 0, 0, 1, 0, 0, 0, 0]),
    "on the other wall": ((1.0, 0.0), {}, [0, 0, 0, -1, 0, 0, 0, 0]),
    "coupled by a spring alone": ((1.0, 0.0), dict(gamma12_hat=0.0), [0, 0, 0, 1, 0, 0, 0, 0]),
    "coupled by a damper alone": ((1.0, 0.0), dict(alpha12_hat=0.0), [0, 0, 0, -1, 0, 0, 0, 0]),
    "uncoupled": ((1.0, 0.0), UNCOUPLED, [0, 0, 0, -1, 0, 0, 0, 0]),
}


@pytest.mark.parametrize(("force", "changes", "start"), REST.values(), ids=REST)
def test_balls_at_rest_on_walls_without_a_force(chapter, force, changes, start):
    system = chapter(*force, **changes)
    run = vi.simulate(system, start, 2)
    truth = reference_run(system, start, 2, 40)
    np.testing.assert_allclose(run.final, truth.final, atol=1e-12)


@pytest.mark.parametrize("position", [1.0, 1.0 - 2**-52, 1.0 + 2**-52])
@pytest.mark.parametrize("ball", [0.0, 2.0])
def test_a_contact_force_that_only_touches_zero_at_the_start(chapter, position, ball):
    system = chapter(
        1.0, 0.0, **UNCOUPLED, epsilon=1.0, gamma1_hat=0.0, gamma2_hat=0.0, sigma20_hat=0.0, sigma_e_hat=0.25
    )
    start = [position, ball + position - 1.0, 0, 0, 0, 0, 0, 0]
    run = vi.simulate(system, start, 1, tau0=system.period / 4)
    assert len(run.events) < 200
    wall = 1 if ball == 0.0 else -1
    start[:2] = Fraction(position), Fraction(position) - wall  # exactly on the wall, as the engine takes it
    truth = reference_run(system, start, 1, 80, tau0=system.period / 4)
    np.testing.assert_allclose(run.final, truth.final, rtol=0, atol=1e-13)


def test_a_chatter_without_end_in_sight_is_given_up(chapter):
    system = chapter(0.0, 0.0, **UNCOUPLED, kappa=1 - 1e-9)
    with pytest.raises(ArithmeticError, match="there are too many events"):
        vi.simulate(system, [-1.5, -2.5, 0, 0, 0, 1e-7, 0, 0], 1)


@pytest.mark.parametrize(
    ("f10_hat", "f20_hat", "start", "miss"),
    [
        (0.634, 0.614, [0, -0.528, 0, 0.327, 0, 0.477, 0, -0.261], 1.87e-4),
        (1.097, 0.85, [0, 0.761, 0, 0.021, 0, -0.574, 0, -0.735], 6.2e-4),
    ],
)
def test_the_nearest_miss_is_the_one_that_dense_samples_show(chapter, f10_hat, f20_hat, start, miss):
    run = vi.simulate(chapter(f10_hat, f20_hat), start, 20)
    assert run.certificate.nearest_miss == pytest.approx(miss, rel=0.01)


def test_no_run_is_decided_beyond_its_horizon(chapter):
    run = vi.simulate(chapter(0.65, 0.65), [0.1, 0, 0.2, 0, 0, 0.398, 0, -0.2], 60)
    assert run.certificate.horizon < run.tau0 + 60 * run.system.period
    assert run.certificate.error == np.inf
    assert not run.certificate.decided


def test_the_error_includes_the_rounding_of_the_final_state():
    system = vi.System(
        epsilon=0.5, kappa=0.65, alpha12_hat=60, gamma1_hat=0, gamma2_hat=10, gamma12_hat=0, sigma20_hat=0.6,
        sigma_e_hat=-1.8, f10_hat=200, f20_hat=20,
    )  # fmt: skip
    run = vi.simulate(system, [0.084525, 1.084524, 1.149032, 0.949032, 0, 0, 0, 0.5], 1)
    assert run.certificate.error >= np.finfo(float).eps * np.abs(run.final).max()


@pytest.mark.parametrize("cycles", [np.nan, np.inf, None, "3", True])
def test_cycles_that_are_no_number_of_cycles(chapter, cycles):
    with pytest.raises(ValueError, match=r"cycles: .* is not a whole number"):
        vi.simulate(chapter(), np.zeros(8), cycles)


SYMMETRIC = {
    # both chatters end at once: changes, forces, cycles, start
    "in phase": (
        dict(epsilon=0.8927, kappa=0.8101, alpha12_hat=2.678, gamma12_hat=1.7393, sigma_e_hat=0.6698),
        (0.8381, -0.1113, -0.1113),
        3,
        [0.388, -0.611999999, 0.388, -0.611999999, -0.529, -0.52901, -0.529, -0.52901],
    ),
    "in antiphase": (
        dict(epsilon=0.0917, kappa=0.9442, alpha12_hat=0.8535, gamma12_hat=1.0418, sigma_e_hat=46.3728),
        (0.68, 1.9352, -1.9352),
        8,
        [-0.2794, -1.27939999999, 0.2794, 1.27939999999, 0.6108, 0.6098, -0.6108, -0.6098],
    ),
}


@pytest.mark.parametrize(("changes", "numbers", "cycles", "start"), SYMMETRIC.values(), ids=SYMMETRIC)
def test_chatters_of_symmetric_modules_that_end_at_once(chapter, changes, numbers, cycles, start):
    damping, *forces = numbers
    system = chapter(*forces, **changes, gamma1_hat=damping, gamma2_hat=damping, sigma20_hat=0.0)
    run, truth = vi.simulate(system, start, cycles), reference_run(system, start, cycles, 40)
    np.testing.assert_allclose(run.final, truth.final, rtol=0, atol=1e-13)
    assert run.certificate.decided
    for module in (1, 2):
        sticks, true_sticks = (
            [event["tau"] for event in events if event["module"] == module and event["kind"] == STICK]
            for events in (run.events, truth.events)
        )
        early = np.array(true_sticks) - sticks  # see docs/engine.md, coincident events
        assert early.min() > -1e-9
        assert early.max() < 2e-5
