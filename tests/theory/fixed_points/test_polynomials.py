"""Common zeros of constructed polynomials are found; (10.24) and its singular points are as the derivation states."""

import numpy as np
import pytest

import vibroimpact as vi
from chapter import system_of
from vibroimpact.theory import manifold
from vibroimpact.theory.fixed_points.balance import determinant, singular_points
from vibroimpact.theory.fixed_points.real_zeros import real_zeros


def from_roots(a, b):
    """Return the coefficients of (x - a)(x - b), constant first."""
    return np.array([a * b, -(a + b), 1.0])


ONE = np.array([1.0, 0.0, 0.0])
CIRCLE = np.outer([0, 0, 1.0], ONE) + np.outer(ONE, [0, 0, 1.0]) - np.outer(ONE, ONE)  # x^2 + y^2 = 1


def line(slope, offset):
    """Return the coefficients of y - slope x - offset."""
    return np.outer(ONE, [0, 1.0, 0]) - slope * np.outer([0, 1.0, 0], ONE) - offset * np.outer(ONE, ONE)


def solve(*polynomials):
    coefficients = np.array(polynomials)
    return real_zeros(coefficients, np.abs(coefficients), 10.0)


@pytest.mark.parametrize(
    "roots",
    [
        ((0, 1), (0, -1)),  # on the lines that divide the square
        ((0.3, 0.3 + 1e-5), (-7, 9.999)),  # close to each other and to the edge
        ((-2.5, 5), (1.25, -0.625)),
    ],
)
def test_all_zeros_on_a_grid_are_found(roots):
    in_x, in_y = roots
    zeros, multiple = solve(np.outer(from_roots(*in_x), ONE), np.outer(ONE, from_roots(*in_y)))
    expected = sorted((x, y) for x in in_x for y in in_y)
    assert np.array(zeros) == pytest.approx(np.array(expected), abs=1e-10)
    assert not multiple.any()


@pytest.mark.parametrize("offset", [0.0, 0.5, 1.0, 1.3, 1.4142])
def test_intersections_of_circle_and_line_are_found(offset):
    zeros, multiple = solve(CIRCLE, line(1.0, offset))
    x = np.roots([2, 2 * offset, offset**2 - 1])
    expected = np.sort(x.real)
    assert zeros[:, 0] == pytest.approx(expected, abs=1e-9)
    assert zeros[:, 1] == pytest.approx(expected + offset, abs=1e-9)
    assert not multiple.any()


def test_a_tangent_has_one_multiple_zero():
    zeros, multiple = solve(CIRCLE, line(0.0, 1.0))
    assert zeros == pytest.approx(np.array([[0.0, 1.0]]), abs=1e-6)
    assert multiple.tolist() == [True]


def test_a_double_zero_next_to_a_simple_zero_is_found_once():
    """(x - 1) y^2 = 0 and x = y have a double zero at the origin and a simple one at (1, 1)."""
    zeros, multiple = solve(np.outer([-1.0, 1.0, 0], [0, 0, 1.0]), line(1.0, 0.0))
    assert zeros == pytest.approx(np.array([[0.0, 0.0], [1.0, 1.0]]), abs=1e-6)
    assert multiple.tolist() == [True, False]


@pytest.mark.parametrize("gap", [1e-3, 1e-6, 1e-10])
def test_a_near_miss_has_no_zero(gap):
    zeros, _ = solve(CIRCLE, line(0.0, 1.0 + gap))
    assert len(zeros) == 0


def test_polynomials_without_isolated_zeros_are_refused():
    with pytest.raises(ArithmeticError):
        solve(CIRCLE, CIRCLE)


SYSTEM = system_of("equal", gamma2_hat=0.3, gamma12_hat=0.15)


def eliminated(system, C):
    """Return B (2,), the denominator d, h_1 and h_2 as functions of (C_1, C_2), as docs/derivation.md states them."""
    r, mu = manifold.rho(system.kappa), 8 / np.pi**2
    C = np.asarray(C)
    B = manifold.B_of_C(C, r)
    K = system.alpha12_hat + 1j * system.gamma12_hat
    own = np.array([0, system.sigma20_hat]) - 2 * system.sigma_e_hat
    a = own + 1j * np.array([system.gamma1_hat, system.gamma2_hat]) + K + mu * C / (1 - (1 + 1j * r) * C)
    f = np.array([system.f10_hat, system.f20_hat])
    G = abs(a) ** 2 * B**2 + abs(K) ** 2 * B[::-1] ** 2 - f**2
    x, s = (a * K.conjugate()).real, (a * K.conjugate()).imag
    d = x[0] * s[1] + x[1] * s[0]
    cross, both = a[0].conjugate() * a[1], a[0] * a[1] * K.conjugate() ** 2
    squares = abs(K) ** 2 * (abs(a[1] * G[0]) ** 2 + abs(a[0] * G[1]) ** 2) - 2 * G[0] * G[1] * both.real
    h1 = squares / (4 * B.prod() ** 2 * d**2) - 1
    linear = (cross.real + abs(K) ** 2) * (s[1] * G[0] + s[0] * G[1]) + cross.imag * (x[0] * G[1] - x[1] * G[0])
    h2 = linear / (2 * d) - x @ B**2 - f.prod()
    return B, d, h1, h2


@pytest.mark.parametrize("f20_hat", [1.0, 0.89, 0.6])
def test_fixed_points_satisfy_10_24_as_documented(f20_hat):
    system = SYSTEM.with_(f20_hat=f20_hat)
    for point in vi.fixed_points(system):
        assert np.abs(eliminated(system, point.C)[2:]).max() < 1e-10
        assert np.abs(eliminated(system, point.C + 0.01)[2:]).max() > 1e-4


@pytest.mark.parametrize("C", [(0.2, 2.2), (1.1, 1.7), (0.9, 0.95), (3.0, 0.05)])
def test_the_determinant_is_proportional_to_the_denominator(C):
    B, d, *_ = eliminated(SYSTEM, C)
    assert determinant(SYSTEM, C) == pytest.approx(B.prod() ** 2 * d, rel=1e-12)


@pytest.mark.parametrize("module", [1, 2])
@pytest.mark.parametrize("f20_hat", [1.0, 0.89, 0.5])
def test_all_singular_points_are_found(f20_hat, module):
    """The determinant is a quadratic polynomial in each C, determined by three values."""
    system = system_of("equal", f20_hat=f20_hat)

    def value(C):
        return determinant(system, (C, point.C[1]) if module == 1 else (point.C[0], C))

    for point in vi.fixed_points(system):
        quadratic = np.polyfit([0.0, 1.0, 2.0], [value(0.0), value(1.0), value(2.0)], 2)
        assert value(7.0) == pytest.approx(np.polyval(quadratic, 7.0), rel=1e-9)
        zeros = np.sort([root.real for root in np.roots(quadratic) if np.isreal(root) and root.real >= 0])
        found = singular_points(system, point, module)
        assert found[:, 0] == pytest.approx(zeros, rel=1e-9)
        assert found[:, 1] == pytest.approx(manifold.B_of_C(found[:, 0], manifold.rho(system.kappa)), rel=1e-14)


def test_uncoupled_modules_have_no_singular_points():
    uncoupled = SYSTEM.with_(alpha12_hat=0.0, gamma12_hat=0.0)
    (point,) = vi.fixed_points(uncoupled)
    assert singular_points(uncoupled, point, 1).shape == (0, 2)


def test_a_fixed_point_can_be_singular_without_a_bifurcation():
    """Between f20 = 0.92 and 0.91 the determinant changes sign at a fixed point that persists.

    The chapter states: "if P_i gets closer to S_i, the fixed point becomes a singular point, potentially associated to
    a bifurcation".
    """
    values = []
    for f20_hat in (0.92, 0.91):
        system = system_of("equal", f20_hat=f20_hat)
        points = vi.fixed_points(system)
        assert len(points) == 3
        values.append(determinant(system, points[1].C))
    assert values[0] < 0 < values[1]
