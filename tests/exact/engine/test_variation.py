"""The Jacobian of a run and its certificate against differences and errors in arbitrary precision."""

from fractions import Fraction

import numpy as np
import pytest

import vibroimpact as vi
from vibroimpact.accuracy.reference.run import reference_run
from vibroimpact.system.state import IMPACT, RELEASE, STICK

STEP = Fraction(1, 10**25)


def jacobian_in_high_precision(system, state, cycles, digits=60):
    """Central differences of step 1e-25 of the event-driven map, 60 digits."""
    columns = []
    for k in range(8):
        ends = []
        for sign in (1, -1):
            shifted = [Fraction(str(x)) for x in state]
            shifted[k] += sign * STEP
            ends.append(reference_run(system, shifted, cycles, digits).final_exact)
        columns.append([float((a - b) / (2 * float(STEP))) for a, b in zip(*ends, strict=True)])
    return np.array(columns).T


PROBLEMS = {
    # name: (changes of the chapter's system, forcing, start, cycles, kinds of events that must occur)
    "impacts": ({}, (1.0, 1.0), [0.1, 0.0, 0.2, 0.0, 0.0, 0.3, 0.0, -0.2], 3, {IMPACT}),
    "chatter, stick, release": (
        {"gamma12_hat": 2.0}, (0.3, 0.2), [-1.5, -2.499, 0.4, 0.1, 0.0, 0.05, 0.1, -0.2], 1, {IMPACT, STICK, RELEASE},
    ),
    "chatter in both modules": (
        {"gamma12_hat": 1.0}, (0.3, 0.2),
        [-1.5, -2.499, 1.4, 2.398, 0.0, 0.05, 0.0, -0.04], 1, {IMPACT, STICK, RELEASE},
    ),
    "release forced by an impact": (
        {"epsilon": 0.5, "gamma12_hat": 4.0, "alpha12_hat": 0.3}, (0.0, 0.0),
        [-0.3, -1.2995, 0.0, 0.1, 0.0, 0.002, 0.0, -3.0], 1, {IMPACT, STICK, RELEASE},
    ),
}  # fmt: skip


@pytest.mark.parametrize(("changes", "force", "start", "cycles", "kinds"), PROBLEMS.values(), ids=PROBLEMS)
def test_jacobian_against_high_precision_differences(chapter, changes, force, start, cycles, kinds):
    system = chapter(*force, **changes)
    run = vi.simulate(system, start, cycles)
    assert set(run.events["kind"]) == kinds
    expected = jacobian_in_high_precision(system, start, cycles)
    np.testing.assert_allclose(run.jacobian, expected, rtol=0, atol=1e-9 * np.abs(expected).max())


def test_jacobian_of_impacts_that_leave_hardly_any_velocity(chapter):
    system, start = chapter(kappa=1e-12), [0.1, 0.0, 0.2, 0.0, 0.0, 0.3, 0.0, -0.2]
    run = vi.simulate(system, start, 3)
    assert set(run.events["kind"]) == {IMPACT, STICK, RELEASE}
    expected = jacobian_in_high_precision(system, start, 3, digits=80)
    np.testing.assert_allclose(run.jacobian, expected, rtol=0, atol=1e-14 * np.abs(expected).max())
