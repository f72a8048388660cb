"""The labels of the chapter's fixed points against the text's sentences about Figs. 10.6, 10.7 and 10.9."""

import pytest

import vibroimpact as vi
from chapter import PARAMETERS
from vibroimpact.theory import manifold
from vibroimpact.theory.fixed_points.labels import labels
from vibroimpact.theory.masri_printed import printed_limit


def labelled(f20_hat):
    system = vi.System(**PARAMETERS, f10_hat=1.0, f20_hat=f20_hat)
    points = vi.fixed_points(system)
    return dict(zip(labels(system, points), points, strict=True)), manifold.rho(system.kappa)


@pytest.mark.parametrize("f20_hat", [1.0, 0.89])
def test_a_is_unstable_with_its_first_projection_on_the_left_arm(f20_hat):
    points, r = labelled(f20_hat)
    assert sorted(points) == ["a", "b", "c"]
    assert points["a"].C[0] < printed_limit(r) < manifold.C_min(r) < points["a"].C[1]


def test_b_and_c_of_equal_forces_are_stable_by_10_26():
    points, r = labelled(1.0)
    assert min(points["b"].C) > printed_limit(r)
    assert min(points["c"].C) > printed_limit(r)


def test_only_c_of_unequal_forces_is_on_right_arms_alone():
    points, r = labelled(0.89)
    assert [name for name, point in points.items() if min(point.C) > manifold.C_min(r)] == ["c"]


def test_projections_of_c_move_left_and_down_the_right_arm():
    before, r = labelled(1.0)
    after, _ = labelled(0.89)
    assert (after["c"].C < before["c"].C).all()
    assert (after["c"].B < before["c"].B).all()
    assert min(after["c"].C) > manifold.C_min(r)


def test_c_of_equal_forces_is_the_stable_point_of_the_slow_flow_beside_a():
    points, _ = labelled(1.0)
    growth = {name: point.slow_eigenvalues.real.max() for name, point in points.items()}
    assert growth["c"] < 0 < growth["b"]
