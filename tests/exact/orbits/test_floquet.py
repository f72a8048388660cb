"""Multipliers agree with a map in 40 digits, Liouville's formula and runs, and verdicts follow from them."""

from dataclasses import replace

import mpmath as mp
import numpy as np
import pytest

import vibroimpact as vi
from stroboscope import ORDER, Stroboscope
from vibroimpact.exact.orbits.floquet import floquet, impact_saltation, multipliers, restitution_matrix, vector_field
from vibroimpact.exact.orbits.search import half_period_multipliers, orbits, symmetric_orbit
from vibroimpact.exact.orbits.symmetric import symmetric_solutions

BEFORE = np.array([0.3, -0.7, 0.2, 0.1, 0.9, -0.4, -0.3, 0.6])
TAU = 1.7


def least_unstable(case):
    """Yield one symmetric orbit and, if there is one, one asymmetric orbit."""
    listed = [o for o in orbits(case) if o.admissible]
    for kind in (True, False):
        same = [o for o in listed if o.symmetric is kind]
        yield from [min(same, key=lambda o: abs(o.multipliers[0]))] if same else []


def test_monodromy_matrix_and_multipliers_agree_with_extended_precision(case):
    with mp.workdps(40):
        for orbit in least_unstable(case):
            expected = Stroboscope(orbit).jacobian(mp.matrix(orbit.state[ORDER].tolist()))
            exact = np.array(expected.tolist(), dtype=float)
            np.testing.assert_allclose(orbit.passage.jacobian[np.ix_(ORDER, ORDER)], exact, rtol=0, atol=1e-9)
            values = np.array(mp.eig(expected, left=False, right=False), dtype=complex)
            distances = abs(values[:, None] - orbit.multipliers)
            assert max(distances.min(axis=0).max(), distances.min(axis=1).max()) < 1e-9


@pytest.mark.parametrize("module", [1, 2])
@pytest.mark.parametrize("gamma12_hat", [0.0, 0.2])
@pytest.mark.parametrize("kappa", [0.1, 0.65, 0.99])
def test_the_saltation_matrix_satisfies_its_definition(chapter, module, gamma12_hat, kappa):
    """S maps the vector field before the impact to that after it, and displacements along the wall by the impact law.

    Its determinant is kappa^2.
    """
    system = chapter(gamma12_hat=gamma12_hat, kappa=kappa)
    law, saltation = restitution_matrix(system, module), impact_saltation(system, BEFORE, TAU, module)
    carried = saltation @ vector_field(system, BEFORE, TAU)
    np.testing.assert_allclose(carried, vector_field(system, law @ BEFORE, TAU), rtol=0, atol=1e-14)
    along = np.random.default_rng(3).normal(size=8)
    along[2 * module - 1] = along[2 * module - 2]
    np.testing.assert_allclose(saltation @ along, law @ along, rtol=0, atol=1e-14)
    assert np.linalg.det(saltation) == pytest.approx(kappa**2, rel=1e-12)
    grazing = BEFORE.copy()
    grazing[2 * module + 3] = grazing[2 * module + 2]
    with pytest.raises(ValueError, match="grazing"):
        impact_saltation(system, grazing, TAU, module)


@pytest.mark.parametrize("changes", [{}, {"kappa": 0.3}, {"gamma12_hat": 2.0}, {"epsilon": 0.7, "gamma1_hat": 0.0}])
def test_the_product_of_multipliers_is_that_of_liouville_s_formula(chapter, changes):
    """The formula is the exponential of the integrated divergence times kappa^2 for each of four impacts."""
    system = chapter(**changes)
    damping = system.gamma1 + system.gamma2 + 2 * system.gamma12
    expected = np.exp(-damping * system.period) * system.kappa**8
    found = orbits(system)
    assert found
    for orbit in found:
        scale = np.prod(np.maximum(abs(orbit.multipliers), 1))
        assert np.prod(orbit.multipliers) == pytest.approx(expected, rel=1e-11 * scale / expected)


def test_half_period_multipliers_square_to_the_multipliers(case):
    for orbit in orbits(case):
        if orbit.symmetric:
            distances = abs(half_period_multipliers(orbit)[:, None] ** 2 - orbit.multipliers)
            assert (distances.min(axis=0) < 1e-9 * np.maximum(1.0, abs(orbit.multipliers))).all()
        else:
            with pytest.raises(ValueError, match="not symmetric"):
                half_period_multipliers(orbit)


def test_multipliers_are_in_descending_order_of_modulus():
    matrix = np.diag([0.1, -3.0, 1.0, 0.5, 0.2, 0.3, 0.0, 0.0])
    matrix[6:, 6:] = [[0.0, -2.0], [2.0, 0.0]]
    np.testing.assert_allclose(multipliers(matrix), [-3, 2j, -2j, 1, 0.5, 0.3, 0.2, 0.1], atol=1e-15)


def test_perturbed_runs_follow_the_matrix_and_approach_stable_orbits_only(case):
    """After one cycle the perturbation is that of the matrix; after many it has decayed, or grown if unstable."""
    direction = np.random.default_rng(3).normal(size=8)
    for orbit in (o for o in orbits(case) if o.admissible):
        jacobian, verdict = orbit.passage.jacobian, floquet(orbit)
        ends = [vi.simulate(case, orbit.state + side * 1e-6 * direction, 1).final for side in (1, -1)]
        expected = 1e-6 * jacobian @ direction
        np.testing.assert_allclose((ends[0] - ends[1]) / 2, expected, rtol=0, atol=1e-9 * abs(jacobian).max() ** 2)
        cycles = 400 if verdict == "stable" else 120
        gap = np.abs(vi.simulate(case, orbit.state + 1e-7 * direction, cycles).final - orbit.state).max()
        assert (verdict, gap < 1e-7) in {("stable", True), ("unstable", False)}


def test_the_verdict_is_undecided_only_at_the_symmetry_breaking(chapter):
    """Two equal uncoupled modules: bisection finds the force at which the symmetric motion becomes unstable."""

    def symmetric(f):
        system = chapter(f, f, epsilon=0.01, alpha12_hat=0, gamma12_hat=0, sigma20_hat=0)
        return symmetric_orbit(system, max(symmetric_solutions(system), key=lambda root: root[2:].min()))

    low, high = 1.6, 1.7
    while low < (middle := (low + high) / 2) < high:
        low, high = (middle, high) if np.abs(symmetric(middle).multipliers).max() < 1 else (low, middle)
    verdicts = [floquet(symmetric(f)) for f in (low - 1e-4, low, high, high + 1e-4)]
    assert verdicts == ["stable", "undecided", "undecided", "unstable"]


def test_the_largest_modulus_decides_unless_the_residual_is_large(case):
    for orbit in orbits(case):
        largest = np.abs(orbit.multipliers).max()
        assert floquet(orbit) == ("stable" if largest < 1 else "unstable")
        if orbit.admissible:
            verdicts = [floquet(replace(orbit, residual=residual)) for residual in (1e-13, 1.0)]
            assert [verdict == "undecided" for verdict in verdicts] == [False, True]
