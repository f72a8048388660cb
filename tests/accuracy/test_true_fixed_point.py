"""The fixed points that scene_models takes for true, with any mpmath that pyproject.toml allows."""

import numpy as np

import vibroimpact as vi
from chapter import PARAMETERS
from vibroimpact.accuracy.scene_models import true_fixed_point

SYSTEM = vi.System(**PARAMETERS, f10_hat=1.0, f20_hat=1.0)


def test_a_true_fixed_point_is_the_one_of_the_theory_to_rounding():
    points = vi.fixed_points(SYSTEM)
    assert len(points) == 3
    for point in points:
        truth = true_fixed_point(SYSTEM, point)
        np.testing.assert_allclose(np.array([*truth.C, *truth.B], float), [*point.C, *point.B], rtol=0, atol=1e-13)
        turns = (np.array(truth.psi, float) - point.psi) / (2 * np.pi)
        np.testing.assert_allclose(turns, turns.round(), rtol=0, atol=1e-13)
