"""The asymmetric branch against the ball itself: flown, perturbed, sampled."""

import numpy as np
import pytest

from vibroimpact.theory import masri
from vibroimpact.theory.asymmetric import branch

PLACES = [(0.02, 0.65), (0.3, 0.65), (0.45, 0.3), (0.6, 0.9)]
"""v and kappa; the ball stays inside at all but the last."""


@pytest.mark.parametrize("kappa", [0.1, 0.65, 0.95])
def test_the_branch_begins_where_symmetry_breaks_and_only_grows(kappa):
    squared = np.linspace(0, 0.99, 400)
    C, B = branch.amplitudes(squared, kappa)
    assert C[0] == pytest.approx(masri.SYMMETRY_BREAKING_C, rel=1e-14)
    assert (np.diff(C) > 0).all()
    assert (np.diff(B) > 0).all()
    assert C.max() < 2
    np.testing.assert_allclose(
        np.sort(branch.multipliers(0.0, kappa).real), np.sort(masri.multipliers(C[0], kappa).real), rtol=1e-9
    )


@pytest.mark.parametrize("kappa", [1e-6, 0.65, 0.95, 0.999])
def test_the_branch_is_stable_up_to_a_period_doubling(kappa):
    end = branch.period_doubling(kappa)
    assert (np.diff(branch.trace(np.linspace(0, 1.2 * end, 100), kappa)) < 0).all()
    assert min(abs(branch.multipliers(end, kappa) + 1)) < 1e-9
    for squared, said in ((0.5 * end, "stable"), (end, "undecided"), (1.01 * end, "unstable"), (-0.01, "unstable")):
        assert branch.stable(squared, kappa) == said
        inside = bool((abs(branch.multipliers(squared, kappa)) < 1).all())
        assert said == "undecided" or inside == (said == "stable")


@pytest.mark.parametrize("kappa", [0.9, 0.99, 1 - 1e-9])
def test_where_multipliers_come_back_into_the_circle_the_ball_is_outside(kappa):
    squared = np.linspace(1.01 * branch.period_doubling(kappa), 0.999, 200)
    back = [one for one in squared if branch.stable(one, kappa) == "stable"]
    assert back
    assert min(branch.overshoot(np.sqrt(one), kappa) for one in back) > 0.1


@pytest.mark.parametrize(("v", "kappa"), PLACES)
def test_overshoot_is_that_of_a_sampled_flight(v, kappa):
    B = branch.amplitudes(v**2, kappa)[1]
    a, b = branch.impact_phases(v, kappa)
    largest = 1.0
    for wall, start, end, share in ((1, a, b, (1 + v) / 2), (-1, b, a + 2 * np.pi, (1 - v) / 2)):
        x = np.linspace(start, end, 20001)
        W = wall + B * (np.sin(x) - np.sin(start)) - wall * branch.slope_change(v, kappa) * share * (x - start)
        largest = max(largest, abs(W).max())
    assert branch.overshoot(v, kappa) == pytest.approx(largest - 1, abs=1e-6)
    assert branch.overshoot(-v, kappa) == pytest.approx(branch.overshoot(v, kappa), abs=1e-12)
