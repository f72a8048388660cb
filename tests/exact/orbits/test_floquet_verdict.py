"""The verdict of the multipliers against what a simulation does, and near the threshold."""

import numpy as np
import pytest

import vibroimpact as vi
from vibroimpact.exact.orbits.floquet_verdict import floquet
from vibroimpact.exact.orbits.search import orbits, symmetric_orbit
from vibroimpact.exact.orbits.symmetric import symmetric_solutions


def test_a_stable_orbit_draws_a_perturbed_start_back_and_an_unstable_one_does_not(case):
    """Pushed along the most dangerous direction there is: a random one, after many cycles."""
    push = 1e-7 * np.random.default_rng(3).normal(size=8)
    for orbit in orbits(case):
        if not orbit.admissible:
            continue
        verdict = floquet(orbit)
        cycles = 400 if verdict == "stable" else 120
        gap = np.abs(vi.simulate(case, orbit.state + push, cycles).final - orbit.state).max()
        assert (verdict, gap < 1e-7) in {("stable", True), ("unstable", False)}


def test_undecided_where_symmetry_breaks_and_only_there(chapter):
    """One module twice, without coupling: the forcing rises until the symmetric motion is unstable."""

    def symmetric(f):
        system = chapter(f, f, epsilon=0.01, alpha12_hat=0, gamma12_hat=0, sigma20_hat=0)
        largest = max(symmetric_solutions(system), key=lambda root: root[2:].min())
        return symmetric_orbit(system, largest)

    low, high = 1.6, 1.7
    while low < (middle := (low + high) / 2) < high:
        low, high = (middle, high) if np.abs(symmetric(middle).multipliers).max() < 1 else (low, middle)
    verdicts = [floquet(symmetric(f)) for f in (low - 1e-4, low, high, high + 1e-4)]
    assert verdicts == ["stable", "undecided", "undecided", "unstable"]


def test_moduli_decide(case):
    for orbit in orbits(case):
        largest = np.abs(orbit.multipliers).max()
        assert abs(largest - 1) > 1e-3
        assert floquet(orbit) == ("stable" if largest < 1 else "unstable")


@pytest.mark.parametrize("residual", [1e-13, 1.0])
def test_a_large_residual_leaves_it_undecided(case, residual):
    orbit = next(o for o in orbits(case) if o.admissible)
    doubtful = type(orbit)(**{**vars(orbit), "residual": residual})
    assert (floquet(doubtful) == "undecided") == (residual == 1.0)
