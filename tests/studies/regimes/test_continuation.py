"""Curves whose folds and zeros are known in closed form."""

from itertools import pairwise

import numpy as np
import pytest

from vibroimpact.studies.regimes.continuation import Curve


def circle(x, p):
    return np.array([x[0] ** 2 + p**2 - 1]), np.array([[2 * x[0]]])


def spiral(x, p):
    """x_1 = p, x_2 = sin(3 x_1): a curve without folds in two unknowns."""
    return np.array([x[0] - p, x[1] - np.sin(3 * x[0])]), np.array([[1.0, 0.0], [-3 * np.cos(3 * x[0]), 1.0]])


def anywhere(z):
    return True


def test_a_closed_curve_is_followed_round_both_folds():
    points = np.array([place.z for place in Curve(circle).trace(np.array([1.0, 0.0]), np.eye(2)[1], 0.1, anywhere, 90)])
    np.testing.assert_allclose(np.hypot(*points.T), 1, rtol=1e-12)
    assert points[:, 1].max() > 0.99
    assert points[:, 1].min() < -0.99
    assert np.linalg.norm(points[1:] - points[0], axis=1).min() < 0.1


def test_points_are_roots_and_tangents_are_along_the_curve():
    for place in Curve(spiral).trace(np.zeros(3), np.eye(3)[2], 0.05, lambda z: z[2] < 1):
        x1, x2, p = place.z
        assert (x1, x2) == pytest.approx((p, np.sin(3 * p)), abs=1e-13)
        along = np.array([1.0, 3 * np.cos(3 * p), 1.0])
        np.testing.assert_allclose(place.tangent, along / np.linalg.norm(along), atol=1e-9)


def test_the_first_point_outside_is_the_last():
    points = [place.z[2] for place in Curve(spiral).trace(np.zeros(3), -np.eye(3)[2], 0.05, lambda z: z[2] > -0.4)]
    assert points[-1] <= -0.4 < points[-2]
    assert np.all(np.diff(points) < 0)


def test_zeros_are_as_sharp_as_the_function_also_at_a_fold():
    curve = Curve(circle)
    places = list(curve.trace(np.array([1.0, 0.0]), np.eye(2)[1], 0.1, anywhere, 40))
    before, after = next((a, b) for a, b in pairwise(places) if a.z[0] > 0 > b.z[0])
    zero = curve.zero(lambda z: z[0], before, after.z)
    np.testing.assert_allclose(zero, [0.0, 1.0], atol=1e-14)
