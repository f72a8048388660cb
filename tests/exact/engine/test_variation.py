"""The Jacobian of a run agrees with finite differences in arbitrary precision."""

from fractions import Fraction

import numpy as np
import pytest

import vibroimpact as vi
from vibroimpact.accuracy.reference.run import reference_run
from vibroimpact.system.state import IMPACT, RELEASE, STICK

STEP = Fraction(1, 10**25)


def jacobian_in_high_precision(system, state, cycles):
    """Return central differences of step 1e-25 of the event-driven map, in 80 digits."""
    columns = []
    for k in range(8):
        ends = []
        for sign in (1, -1):
            shifted = [Fraction(str(x)) for x in state]
            shifted[k] += sign * STEP
            ends.append(reference_run(system, shifted, cycles, 80).final_exact)
        columns.append([float((a - b) / (2 * float(STEP))) for a, b in zip(*ends, strict=True)])
    return np.array(columns).T


PROBLEMS = {
    # name: (changes of the chapter's system, forcing, start, cycles, kinds of events that must occur)
    "impacts": ({}, (1.0, 1.0), [0.1, 0.0, 0.2, 0.0, 0.0, 0.3, 0.0, -0.2], 3, {IMPACT}),
    "almost no rebound": (
        {"kappa": 1e-12}, (1.0, 1.0), [0.1, 0.0, 0.2, 0.0, 0.0, 0.3, 0.0, -0.2], 3, {IMPACT, STICK, RELEASE},
    ),
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
def test_the_jacobian_agrees_with_high_precision_differences(chapter, changes, force, start, cycles, kinds):
    system = chapter(*force, **changes)
    run = vi.simulate(system, start, cycles)
    assert set(run.events["kind"]) == kinds
    expected = jacobian_in_high_precision(system, start, cycles)
    accuracy = 1e-14 if "kappa" in changes else 1e-9
    np.testing.assert_allclose(run.jacobian, expected, rtol=0, atol=accuracy * np.abs(expected).max())
