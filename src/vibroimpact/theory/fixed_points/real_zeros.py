"""Find all real common zeros, in a square, of two polynomials of degree 2 in each of the variables x and y.

The resultant of the polynomials is a polynomial in x alone, of degree 8. The roots of the resultant only give the first
values of x for Newton's method. Therefore rounding errors of these roots do not matter. Zeros that are equal within
rounding are returned as one multiple zero. (Resultants: Cox, Little and O'Shea 2015, Ideals, Varieties, and Algorithms,
section 3.6.)
"""

import numpy as np
from numpy.polynomial import polynomial as poly

_ROUNDING = 100 * np.finfo(float).eps
"""Bound on the rounding error of a polynomial value, relative to the sum of the moduli of all terms."""
_RESOLUTION = 1e-8
_BOXES = _RESOLUTION, 1e-6, 1e-4
"""Half-widths of the squares around a zero in which contraction is tested, relative to max(1, |zero|)."""
_NEARLY_REAL = 1e-2
"""Largest imaginary part, relative to the modulus, of a root of the resultant that is treated as real."""
_CLOSE = 0.03
"""Largest value of a polynomial at a start of Newton's method, relative to the sum of the moduli of its terms."""
_STEPS = 30
_SMALLEST_RADIUS = 1e-30  # powers of a smaller radius would underflow
_SAME = 1e-5
"""Distance within which multiple zeros count as one, relative to max(1, |zero|)."""


def real_zeros(coefficients, magnitudes, radius) -> tuple[np.ndarray, np.ndarray]:
    """Return the common zeros of two polynomials in the square [-radius, radius]^2, and a mask of multiple zeros.

    The zeros have the shape (n, 2) and are sorted by x. The mask has the shape (n,). `coefficients` has the shape
    (2, 3, 3), and entry [:, j, k] belongs to x^j y^k. Each coefficient is a sum of terms. `magnitudes` has the same
    shape and contains the sums of the moduli of these terms.

    Raises
    ------
    ArithmeticError
        If the zeros are not isolated.
    """
    radius = max(radius, _SMALLEST_RADIUS)
    # The scaled coefficients belong to powers of x / radius and y / radius. In these variables the square is [-1, 1]^2.
    scale = np.multiply.outer(radius ** np.arange(3.0), radius ** np.arange(3.0))
    scaled, size = coefficients * scale, magnitudes * scale
    heights = size.max(axis=(1, 2), keepdims=True)
    scaled, size = scaled / heights, size / heights
    zeros = _newton(scaled, size, _starts(scaled, size)) * radius
    zeros = zeros[(np.abs(zeros) <= radius * (1 + _ROUNDING)).all(axis=1)]
    multiple = ~_contract(coefficients, magnitudes, zeros)
    points = _distinct(zeros[~multiple], _RESOLUTION)
    merged = _distinct(zeros[multiple], _SAME)
    merged = [point for point in merged if not any(_near(point, known, _RESOLUTION) for known in points)]
    found = np.reshape([*points, *merged], (-1, 2))
    order = np.lexsort(found.T[::-1])
    return found[order], (np.arange(len(found)) >= len(points))[order]


def _starts(pair, size):
    """Return the points from which Newton's method starts, shape (n, 2).

    At least one of these points is close to each real common zero in the square [-1, 1]^2.

    pair: coefficients of both polynomials, shape (2, 3, 3). Each coefficient is a sum of terms.
    size: sum of the moduli of these terms for each coefficient, shape (2, 3, 3).

    Raises
    ------
    ArithmeticError
        If all coefficients of the resultant vanish within rounding.
    """
    resultant, bound = _resultant(*pair.transpose(0, 2, 1)), _resultant(*np.abs(pair).transpose(0, 2, 1), sign=1)
    if (np.abs(resultant) <= _ROUNDING * bound).all():
        raise ArithmeticError("the fixed points are not isolated and therefore cannot be listed")
    nonzero = np.flatnonzero(np.abs(resultant) > np.finfo(float).tiny)
    roots = poly.polyroots(resultant[: nonzero[-1] + 1])
    roots = roots[np.abs(roots.imag) <= _NEARLY_REAL * np.abs(roots) + _RESOLUTION]
    x = roots.real + roots.imag  # A nearly real pair of roots a +- b i gives the real values a + b and a - b.
    y = np.concatenate([_quadratic(one, x) for one in pair])
    points = np.column_stack([np.tile(x, 4), y])
    points = points[(np.abs(points) < 2).all(axis=1)]
    value, _, noise = _expanded(pair, size, points)
    return points[(np.abs(value) <= _CLOSE * noise / _ROUNDING).all(axis=1)]


def _resultant(one, other, sign=-1):
    """Return the coefficients of the resultant of two polynomials, shape (9,); the resultant is a polynomial in x.

    Entry [k, j] of `one` and of `other` is the coefficient of y^k x^j. Each coefficient of the resultant is a sum of
    terms. The sums of the moduli of these terms are returned if two conditions hold: `one` and `other` contain the
    moduli of the coefficients, and `sign` is 1.
    """

    def minor(j, k):
        return np.convolve(one[j], other[k]) + sign * np.convolve(one[k], other[j])

    return np.convolve(minor(2, 0), minor(2, 0)) + sign * np.convolve(minor(2, 1), minor(1, 0))


def _quadratic(polynomial, x):
    """Return both roots y of a polynomial at each entry of x, as an array of shape (2 n,).

    x has the shape (n,). A negative discriminant (complex roots) is replaced by 0. Therefore the results are real.
    """
    c, b, a = (poly.polyval(x, column) for column in polynomial.T)
    root = np.sqrt(np.maximum(b * b - 4 * a * c, 0.0))
    with np.errstate(divide="ignore", invalid="ignore"):
        q = -(b + np.copysign(root, b)) / 2
        return np.concatenate([q / a, c / q])


def _newton(pair, size, points):
    """Return the zeros that Newton's method reaches from `points`, one zero per row.

    If several points lead to the same zero, the zero appears several times. If a point leads to no zero, the result has
    no row for this point.
    """
    found = [np.empty((0, 2))]
    for _ in range(_STEPS):
        value, gradient, noise = _expanded(pair, size, points)
        with np.errstate(all="ignore"):
            step = (_adjugate(gradient) @ value[..., None])[..., 0] / np.linalg.det(gradient)[:, None]
        there, later = (np.abs(value) <= noise).all(axis=1), points - np.nan_to_num(step)
        # Close to a simple zero, `step` is below sqrt(_ROUNDING). Applying this step gives the last digits.
        last = np.abs(step).max(axis=1) < np.sqrt(_ROUNDING)
        found.append(np.where(last[:, None], later, points)[there])
        points = later[~there & (np.abs(later) < 2).all(axis=1)]
        if not len(points):
            break
    return np.concatenate(found)


def _expanded(pair, size, points):
    """Return the values of both polynomials at `points`, the Jacobians, and bounds on the errors of the values.

    `points`, values and bounds have the shape (n, 2). The Jacobians have the shape (n, 2, 2). `size` contains the sum
    of the moduli of the terms of each coefficient.
    """
    value, by_x, by_y = (_at(points, one) for one in (pair, *_derivatives(pair)))
    return value, np.stack([by_x, by_y], -1), _ROUNDING * _at(np.abs(points), size)


def _at(points, polynomials):
    """Return the values of two polynomials at `points`; values and points have the shape (n, 2).

    Entry [:, j, k] of `polynomials` contains the coefficients of x^j y^k.
    """
    return poly.polyval2d(*points.T, polynomials.transpose(1, 2, 0)).T


def _derivatives(pair):
    """Return the coefficients of the derivatives of a pair of polynomials, first with respect to x, then to y."""
    return poly.polyder(pair, axis=1), poly.polyder(pair, axis=2)


def _adjugate(matrix):
    (a, b), (c, d) = matrix.transpose(1, 2, 0)
    return np.array([[d, -b], [-c, a]]).transpose(2, 0, 1)


def _contract(pair, size, points):
    """Return a mask of the points that are simple zeros, shape (n,).

    A zero is simple if Newton's method contracts in a square around the zero (Kantorovich's theorem). The test uses
    two bounds. Rounding shifts the zero by at most the first bound. Within the square, the Newton step changes by at
    most the second bound. Newton's method contracts if the sum of both bounds is below the half-width of the square.
    """
    _, gradient, noise = _expanded(pair, size, points)
    by_x, by_y = _derivatives(pair)
    second = (*_derivatives(by_x), *_derivatives(by_y))
    bend = 2 * sum(np.abs(_at(points, one)) for one in second)
    with np.errstate(all="ignore"):
        inverse = np.abs(_adjugate(gradient) / np.linalg.det(gradient)[:, None, None])
        shift, change = ((inverse @ each[..., None])[..., 0].max(axis=1) for each in (noise, bend))
    halves = np.multiply.outer(_BOXES, np.maximum(1, np.abs(points).max(axis=1)))
    return (shift + change * halves**2 < halves).any(axis=0)


def _distinct(points, apart):
    """Return the list of the points without repetitions.

    A point is a repetition if its relative distance to an earlier point of the list is at most `apart`.
    """
    found = []
    for point in points:
        if not any(_near(point, known, apart) for known in found):
            found.append(point)
    return found


def _near(one, other, apart):
    return np.abs(one - other).max() <= apart * max(1.0, np.abs(one).max())
