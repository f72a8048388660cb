"""The complete search for common zeros against systems whose zeros are known by construction."""

import numpy as np
import pytest

from vibroimpact.theory.fixed_points.real_zeros import real_zeros


def product(in_x, in_y):
    return np.outer(in_x, in_y)


def from_roots(a, b):
    """(x - a)(x - b), constant first."""
    return np.array([a * b, -(a + b), 1.0])


ONE = np.array([1.0, 0.0, 0.0])
CIRCLE = product([0, 0, 1.0], ONE) + product(ONE, [0, 0, 1.0]) - product(ONE, ONE)  # x^2 + y^2 = 1


def line(slope, offset):
    """y - slope x - offset."""
    return product(ONE, [0, 1.0, 0]) - slope * product([0, 1.0, 0], ONE) - offset * product(ONE, ONE)


def solve(*polynomials, radius=10.0):
    coefficients = np.array(polynomials)
    return real_zeros(coefficients, np.abs(coefficients), radius)


@pytest.mark.parametrize(
    "roots",
    [
        ((0, 1), (0, -1)),  # on the lines where the square is divided
        ((0.3, 0.3 + 1e-5), (-7, 9.999)),  # close together, close to the edge
        ((-2.5, 5), (1.25, -0.625)),
    ],
)
def test_a_grid_of_zeros(roots):
    in_x, in_y = roots
    zeros, multiple = solve(product(from_roots(*in_x), ONE), product(ONE, from_roots(*in_y)))
    expected = sorted((x, y) for x in in_x for y in in_y)
    assert np.array(zeros) == pytest.approx(np.array(expected), abs=1e-10)
    assert not multiple.any()


@pytest.mark.parametrize("offset", [0.0, 0.5, 1.0, 1.3, 1.4142])
def test_circle_and_line(offset):
    zeros, multiple = solve(CIRCLE, line(1.0, offset))
    x = np.roots([2, 2 * offset, offset**2 - 1])
    expected = np.sort(x.real)
    assert zeros[:, 0] == pytest.approx(expected, abs=1e-9)
    assert zeros[:, 1] == pytest.approx(expected + offset, abs=1e-9)
    assert not multiple.any()


def test_a_tangent_gives_one_multiple_zero():
    zeros, multiple = solve(CIRCLE, line(0.0, 1.0))
    assert zeros == pytest.approx(np.array([[0.0, 1.0]]), abs=1e-6)
    assert multiple.tolist() == [True]


def test_a_double_zero_beside_a_simple_one_is_neither_dropped_nor_doubled():
    """(x - 1) y^2 against x = y: double at the origin, simple at (1, 1)."""
    zeros, multiple = solve(product([-1.0, 1.0, 0], [0, 0, 1.0]), line(1.0, 0.0))
    assert zeros == pytest.approx(np.array([[0.0, 0.0], [1.0, 1.0]]), abs=1e-6)
    assert multiple.tolist() == [True, False]


@pytest.mark.parametrize("gap", [1e-3, 1e-6, 1e-10])
def test_a_near_miss_has_no_zero(gap):
    zeros, _ = solve(CIRCLE, line(0.0, 1.0 + gap))
    assert len(zeros) == 0


def test_no_isolated_zeros():
    with pytest.raises(ArithmeticError):
        solve(CIRCLE, CIRCLE)
