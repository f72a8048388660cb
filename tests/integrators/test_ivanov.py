"""Ivanov's coordinates: impacts as the law says, orders of convergence, and what they cannot do."""

import numpy as np
import pytest

from vibroimpact.accuracy.errors import run_errors
from vibroimpact.accuracy.reference.run import proven_run
from vibroimpact.integrators.ivanov import folded, unfolded
from vibroimpact.integrators.protocol import UNFINISHED
from vibroimpact.system.restitution import after_impact

EPSILON, KAPPA = 0.1, 0.65
K = (1.0 - KAPPA) / (1.0 + KAPPA)
STATE = np.array([0.3, -0.7, -0.2, 0.8, 0.5, -0.4, 0.1, 1.2])  # balls 1 and 2 about to meet walls +1 and -1


def test_in_passing_a_wall_the_velocities_jump_as_the_impact_law_says_and_the_coordinates_do_not():
    z = unfolded(STATE, EPSILON, K)
    np.testing.assert_allclose(folded(z, np.array([0, 0]), EPSILON, K), STATE, atol=1e-15)
    after = folded(z, np.array([1, -1]), EPSILON, K)
    np.testing.assert_allclose(after[:4], STATE[:4], atol=1e-15)
    for box, ball in ((4, 5), (6, 7)):
        expected = after_impact(EPSILON, KAPPA, STATE[box], STATE[ball])
        np.testing.assert_allclose(after[[box, ball]], expected, atol=1e-15)


def test_jumps_that_are_not_located_make_it_of_first_order(method, motion):
    """The error of a step depends on where in it the jump falls: it is averaged over neighbouring numbers of steps."""
    system, state, cycles, reference = motion("periodic")
    errors = []
    for steps in (100, 1_000, 10_000):
        runs = [method("Ivanov").run(system, state, cycles, 0.0, steps + n * steps // 100) for n in range(20)]
        finals = [run_errors(run, reference, system.period).final for run in runs]
        errors.append(np.sqrt(np.mean(np.square(finals))))
    slopes = -np.diff(np.log10(errors))
    assert slopes == pytest.approx(1.0, abs=0.25)


def test_a_small_kappa_alone_costs_nothing(method, motion):
    """Near a wall the rate of the equations is sqrt(k a / (1 - k)): it grows like a square root of 1 / kappa only."""
    system, errors = motion("periodic")[0], []
    for kappa in (0.65, 1e-3):
        inelastic = system.with_(kappa=kappa)
        reference = proven_run(inelastic, (0.0,) * 8, 1).run
        run = method("Ivanov, events").run(inelastic, (0.0,) * 8, 1, 0.0, 100)
        errors.append(run_errors(run, reference, system.period).final)
    assert errors == pytest.approx([errors[0]] * 2, rel=0.5)


@pytest.mark.parametrize("steps", [10, 1_000])
def test_located_impacts_of_a_chatter_have_no_end(steps, method, motion):
    system, state, cycles, reference = motion("chatter")
    run = method("Ivanov, events").run(system, state, cycles, 0.0, steps)
    assert run.failure.kind == UNFINISHED
    end = run.impacts["tau"][-1]
    rest = reference.events["tau"][reference.events["kind"] == 1][0]
    assert end == pytest.approx(rest, abs=1e-4)
    assert f"at tau = {rest:.3g}" in run.failure.reason[:40]
