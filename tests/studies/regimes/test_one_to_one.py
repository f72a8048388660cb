"""What symmetric responses amount to: exact against samples of a run, and the theory as its limit."""

import numpy as np
import pytest

import vibroimpact as vi
from chapter import PARAMETERS
from vibroimpact.studies.regimes.one_to_one import by_exact_orbits, by_theory
from vibroimpact.theory.response import leading_order

UNEQUAL = vi.System(**PARAMETERS, f10_hat=1.0, f20_hat=0.89)


def test_an_exact_response_is_that_of_a_simulated_period():
    """Largest of close samples, energies of the certified run; in the order of the list of orbits."""
    orbits = [orbit for orbit in vi.orbits(UNEQUAL) if orbit.symmetric and orbit.admissible]
    found = sorted(by_exact_orbits(UNEQUAL), key=lambda one: one.impact_share)
    runs = [vi.simulate(UNEQUAL, o.state, 1, sample_times=np.linspace(0, UNEQUAL.period, 4001)) for o in orbits]
    expected = sorted((run.energy.impact_share, np.abs(run.samples[:, [0, 2]]).max(axis=0)) for run in runs)
    assert len(found) == len(expected) == 3
    for one, (share, largest) in zip(found, expected, strict=True):
        assert one.impact_share == pytest.approx(share, rel=1e-9)
        np.testing.assert_allclose(one.largest, largest, rtol=1e-6)
    assert not any(one.stable for one in found)  # docs/studies/findings.md


def test_the_theory_is_off_by_the_order_of_epsilon():
    errors = []
    for epsilon in (0.02, 0.01, 0.005):
        system = UNEQUAL.with_(epsilon=epsilon)
        pairs = zip(
            *(sorted(of(system), key=lambda one: one.impact_share) for of in (by_theory, by_exact_orbits)), strict=True
        )
        errors.append([np.append(a.largest / b.largest, a.impact_share / b.impact_share) - 1 for a, b in pairs])
    sizes = np.abs(errors).max(axis=(1, 2))
    np.testing.assert_allclose(sizes[:-1] / sizes[1:], 2.0, rtol=0.15)
    assert sizes[-1] < 0.05


def test_no_sample_of_a_response_exceeds_its_largest():
    system = UNEQUAL.with_(f20_hat=1.0)
    for one, point in zip(by_theory(system), vi.fixed_points(system), strict=True):
        X = leading_order(system, point, np.linspace(0.0, system.period, 100_001)).X
        np.testing.assert_allclose(one.largest, np.abs(X).max(axis=0), rtol=1e-5)
