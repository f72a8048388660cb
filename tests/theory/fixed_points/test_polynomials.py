"""Common zeros known by construction; (10.24) and its singular points as the derivation prints them."""

import numpy as np
import pytest

import vibroimpact as vi
from chapter import PARAMETERS
from vibroimpact.theory import manifold
from vibroimpact.theory.fixed_points.balance import determinant, singular_points
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


CHAPTER = vi.System(**PARAMETERS | dict(gamma2_hat=0.3, gamma12_hat=0.15), f10_hat=1.0, f20_hat=1.0)


def eliminated(system, C):
    """B_1 and B_2, the denominator d, h_1 and h_2 as docs/derivation.md prints them, from (C_1, C_2) alone."""
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
    system = CHAPTER.with_(f20_hat=f20_hat)
    for point in vi.fixed_points(system):
        assert np.abs(eliminated(system, point.C)[2:]).max() < 1e-10
        assert np.abs(eliminated(system, point.C + 0.01)[2:]).max() > 1e-4


@pytest.mark.parametrize("C", [(0.2, 2.2), (1.1, 1.7), (0.9, 0.95), (3.0, 0.05)])
def test_determinant_is_the_denominator(C):
    B, d, *_ = eliminated(CHAPTER, C)
    assert determinant(CHAPTER, C) == pytest.approx(B.prod() ** 2 * d, rel=1e-12)


@pytest.mark.parametrize("module", [1, 2])
@pytest.mark.parametrize("f20_hat", [1.0, 0.89, 0.5])
def test_all_singular_points_are_found(f20_hat, module):
    """The zeros of the determinant along C, a quadratic through three of its values."""
    system = CHAPTER.with_(f20_hat=f20_hat, gamma2_hat=0.2, gamma12_hat=0.2)

    def along(C):
        return determinant(system, (C, point.C[1]) if module == 1 else (point.C[0], C))

    for point in vi.fixed_points(system):
        quadratic = np.polyfit([0.0, 1.0, 2.0], [along(0.0), along(1.0), along(2.0)], 2)
        assert along(7.0) == pytest.approx(np.polyval(quadratic, 7.0), rel=1e-9)
        zeros = np.sort([root.real for root in np.roots(quadratic) if np.isreal(root) and root.real >= 0])
        found = singular_points(system, point, module)
        assert found[:, 0] == pytest.approx(zeros, rel=1e-9)
        assert found[:, 1] == pytest.approx(manifold.B_of_C(found[:, 0], manifold.rho(system.kappa)), rel=1e-14)


def test_uncoupled_modules_have_no_isolated_singular_point():
    uncoupled = CHAPTER.with_(alpha12_hat=0.0, gamma12_hat=0.0)
    (point,) = vi.fixed_points(uncoupled)
    assert singular_points(uncoupled, point, 1).shape == (0, 2)


def test_a_fixed_point_can_be_singular_without_a_bifurcation():
    """Against "if P_i gets closer to S_i, the fixed point becomes a singular point, potentially associated to a
    bifurcation": between f20 = 0.92 and 0.91 the determinant changes sign on a fixed point that persists."""
    chapter = CHAPTER.with_(gamma2_hat=0.2, gamma12_hat=0.2)
    values = []
    for f20_hat in (0.92, 0.91):
        system = chapter.with_(f20_hat=f20_hat)
        points = vi.fixed_points(system)
        assert len(points) == 3
        values.append(determinant(system, points[1].C))
    assert values[0] < 0 < values[1]
