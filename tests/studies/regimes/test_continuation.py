"""Continued curves agree with folds, branch points and zeros in closed form."""

from itertools import pairwise

import numpy as np
import pytest

from vibroimpact.studies.regimes.continuation import Curve, Place


def circle(x, p):
    return np.array([x[0] ** 2 + p**2 - 1]), np.array([[2 * x[0]]])


def spiral(x, p):
    """x_1 = p, x_2 = sin(3 x_1): a curve without folds in two unknowns."""
    return np.array([x[0] - p, x[1] - np.sin(3 * x[0])]), np.array([[1.0, 0.0], [-3 * np.cos(3 * x[0]), 1.0]])


def anywhere(z):
    return True


def test_a_closed_curve_is_followed_through_both_folds():
    curve = Curve(circle)
    places = list(curve.trace(curve.place(np.array([1.0, 0.0]), np.eye(2)[1]), 0.1, anywhere))
    points = np.array([place.z for place in places])
    np.testing.assert_allclose(np.hypot(*points.T), 1, rtol=1e-12)
    np.testing.assert_array_equal(points[-1], points[0])
    assert [place.closing for place in places] == [False] * (len(places) - 1) + [True]
    angles = np.unwrap(np.arctan2(*points.T))
    assert abs(angles[-1] - angles[0]) == pytest.approx(2 * np.pi)


def test_a_closed_curve_in_an_angle_closes_after_one_turn():
    """The curve p = cos x is closed, since x is an angle."""
    curve = Curve(
        lambda x, p: (np.array([p - np.cos(x[0])]), np.array([[np.sin(x[0])]])),
        lambda z, near: [z + 2 * np.pi * np.rint((near - z) / (2 * np.pi)) * [1, 0]],
    )
    *_, last = curve.trace(curve.place(np.array([1.0, np.cos(1.0)]), np.eye(2)[0]), 0.1, anywhere)
    assert last.closing
    assert last.z == pytest.approx([1 + 2 * np.pi, np.cos(1.0)])


def crossing(x, p):
    """x (p - x^2) = 0: a pitchfork."""
    return np.array([x[0] * (p - x[0] ** 2)]), np.array([[p - 3 * x[0] ** 2]])


def corner(x, p):
    """x (p - |x|) = 0: a pitchfork with a kink."""
    return np.array([x[0] * (p - abs(x[0]))]), np.array([[p - 2 * abs(x[0])]])


def transcritical(x, p):
    """x (p - x) = 0."""
    return np.array([x[0] * (p - x[0])]), np.array([[p - 2 * x[0]]])


@pytest.mark.parametrize(
    ("equations", "off"),
    [
        (crossing, [[1.0, 0.0], [-1.0, 0.0]]),
        (corner, [[0.5**0.5, 0.5**0.5], [-(0.5**0.5), 0.5**0.5]]),
        (transcritical, [[0.5**0.5, 0.5**0.5], [-(0.5**0.5), -(0.5**0.5)]]),
    ],
)
def test_branch_points_are_passed_and_have_arms_along_all_branches(equations, off):
    curve = Curve(equations)
    places = list(curve.trace(curve.place(np.array([0.0, -0.43]), np.eye(2)[1]), 0.1, lambda z: z[1] < 0.4))
    assert places[-1].z == pytest.approx([0, places[-1].z[1]], abs=1e-12)
    assert places[-1].z[1] >= 0.4
    [branch_point] = [place.z for place in places if place.determinant == 0]
    assert branch_point == pytest.approx([0, 0], abs=1e-8)
    arms = [arm / np.linalg.norm(arm) for arm in curve.arms(branch_point)]
    for direction in [*off, [0, 1], [0, -1]]:
        assert min(np.linalg.norm(arm - direction) for arm in arms) < 1e-3


@pytest.mark.parametrize("size", [1e-3, 1e-6, 1e-9])
def test_curves_that_nearly_cross_are_distinguished(size):
    """From the left, x (p - x^2) + size = 0 leads to the upper arm of the pitchfork, also at gaps of about 1e-6."""
    curve = Curve(lambda x, p: (crossing(x, p)[0] + size, crossing(x, p)[1]))
    start = curve.step(Place(np.array([0.0, -0.43]), np.eye(2)[1], -1.0), 0.0)
    places = list(curve.trace(curve.place(start, np.eye(2)[1]), 0.1, lambda z: z[1] < 0.4))
    assert all(place.determinant for place in places)
    assert places[-1].z[0] > 0.6


def test_a_corner_is_passed():
    """From the left, p = -|x| rises to the corner at 0 and falls beyond it."""
    curve = Curve(lambda x, p: (np.array([p + abs(x[0])]), np.array([[1.0 if x[0] > 0 else -1.0]])))
    places = list(curve.trace(curve.place(np.array([-0.43, -0.43]), np.eye(2)[1]), 0.1, lambda z: z[1] > -0.6))
    assert places[-1].z[0] == pytest.approx(-places[-1].z[1], abs=1e-12)
    assert max(place.z[1] for place in places) == pytest.approx(0, abs=1e-5)


def test_points_are_roots_with_tangents_along_the_curve_up_to_the_first_point_outside():
    curve = Curve(spiral)
    places = list(curve.trace(curve.place(np.zeros(3), np.eye(3)[2]), 0.05, lambda z: z[2] < 1))
    assert places[-1].z[2] >= 1 > places[-2].z[2]
    for place in places:
        x1, x2, p = place.z
        assert (x1, x2) == pytest.approx((p, np.sin(3 * p)), abs=1e-13)
        along = np.array([1.0, 3 * np.cos(3 * p), 1.0])
        np.testing.assert_allclose(place.tangent, along / np.linalg.norm(along), atol=1e-9)


def test_zeros_are_as_accurate_as_the_function_also_at_a_fold():
    curve = Curve(circle)
    places = list(curve.trace(curve.place(np.array([1.0, 0.0]), np.eye(2)[1]), 0.1, anywhere))
    before, after = next((a, b) for a, b in pairwise(places) if a.z[0] > 0 > b.z[0])
    zero = curve.zero(lambda z: z[0], before, after.z)
    np.testing.assert_allclose(zero, [0.0, 1.0], atol=1e-14)
