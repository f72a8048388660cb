"""The fixed points that scene_models takes for true, with any mpmath that pyproject.toml allows."""

import numpy as np

import vibroimpact as vi
from chapter import PARAMETERS
from vibroimpact.accuracy.scene_models import slow_flow_levels, true_fixed_point

SYSTEM = vi.System(**PARAMETERS, f10_hat=1.0, f20_hat=1.0)


def test_a_true_fixed_point_is_the_one_of_the_theory_to_rounding():
    points = vi.fixed_points(SYSTEM)
    assert len(points) == 3
    for point in points:
        truth = true_fixed_point(SYSTEM, point)
        np.testing.assert_allclose(np.array([*truth.C, *truth.B], float), [*point.C, *point.B], rtol=0, atol=1e-13)
        turns = (np.array(truth.psi, float) - point.psi) / (2 * np.pi)
        np.testing.assert_allclose(turns, turns.round(), rtol=0, atol=1e-13)


def test_of_a_single_machine_its_module_is_solved_for():
    uncoupled = PARAMETERS | {"alpha12_hat": 0.0, "gamma12_hat": 0.0}
    for forces in ({"f10_hat": 1.5, "f20_hat": 0.0}, {"f10_hat": 0.0, "f20_hat": 1.5}):
        system = vi.System(**uncoupled, **forces)
        (point,), i = vi.fixed_points(system), system.modules[0] - 1
        truth = true_fixed_point(system, point)
        found = [float(of[i]) for of in (truth.C, truth.B, truth.psi)]
        np.testing.assert_allclose(found, [point.C[i], point.B[i], point.psi[i]], rtol=0, atol=1e-13)
        for scene in ({"fixed_point": "a"}, {"C_max": [2.5, 2.5]}):
            level = slow_flow_levels(scene, system, [point])[1]
            assert level.error < 1e-12
