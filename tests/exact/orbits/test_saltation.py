"""Properties that define the saltation matrix of an impact; finite differences are in test_floquet.py."""

import numpy as np
import pytest

from vibroimpact.exact.orbits.saltation import impact_matrix, impact_saltation, vector_field
from vibroimpact.system.restitution import after_impact

BEFORE = np.array([0.3, -0.7, 0.2, 0.1, 0.9, -0.4, -0.3, 0.6])
TAU = 1.7


@pytest.mark.parametrize("module", [1, 2])
def test_impact_matrix_is_the_impact_law(chapter, module):
    system = chapter()
    after = impact_matrix(system, module) @ BEFORE
    box, ball = 2 * module + 2, 2 * module + 3
    expected = BEFORE.copy()
    expected[[box, ball]] = after_impact(system.epsilon, system.kappa, BEFORE[box], BEFORE[ball])
    np.testing.assert_allclose(after, expected, rtol=1e-15)


@pytest.mark.parametrize("module", [1, 2])
@pytest.mark.parametrize("gamma12_hat", [0.0, 0.2])
def test_the_motion_itself_passes_unchanged(chapter, module, gamma12_hat):
    """Starting a little later on the same motion ends a little later on it: S f- = f+ at a fixed forcing phase."""
    system = chapter(gamma12_hat=gamma12_hat)
    after = impact_matrix(system, module) @ BEFORE
    saltation = impact_saltation(system, BEFORE, TAU, module)
    carried = saltation @ vector_field(system, BEFORE, TAU)
    np.testing.assert_allclose(carried, vector_field(system, after, TAU), rtol=0, atol=1e-14)


@pytest.mark.parametrize("module", [1, 2])
def test_perturbations_along_the_wall_obey_the_impact_law(chapter, module):
    """A perturbation that keeps the gap keeps the instant of the impact."""
    system = chapter()
    along = np.random.default_rng(3).normal(size=8)
    along[2 * module - 1] = along[2 * module - 2]
    saltation = impact_saltation(system, BEFORE, TAU, module)
    np.testing.assert_allclose(saltation @ along, impact_matrix(system, module) @ along, rtol=0, atol=1e-14)


@pytest.mark.parametrize("module", [1, 2])
@pytest.mark.parametrize("kappa", [0.1, 0.65, 0.99])
def test_determinant(chapter, module, kappa):
    saltation = impact_saltation(chapter(kappa=kappa), BEFORE, TAU, module)
    assert np.linalg.det(saltation) == pytest.approx(kappa**2, rel=1e-12)


@pytest.mark.parametrize("module", [1, 2])
def test_grazing_has_no_saltation_matrix(chapter, module):
    grazing = BEFORE.copy()
    grazing[2 * module + 3] = grazing[2 * module + 2]
    with pytest.raises(ValueError, match="grazing"):
        impact_saltation(chapter(), grazing, TAU, module)
