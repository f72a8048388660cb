"""Prove in interval arithmetic (python-flint's arb) that the lists of fixed points are complete.

One parameter x_i describes module i. It is C_i, 1 / C_i or v_i^2. Here v_i is the flight asymmetry, the difference of
the two flight times divided by the period. The choice of x_i is called the chart of the module. On each pair of charts,
the fixed points are the zeros of |Delta|^2 - |beta_i m_i|^2 for i = 1, 2. docs/derivation.md, section 11, defines these
functions; in the code, m_1 and m_2 are n1 and n2. Together, the squares |x_i| <= 1 of all pairs of charts cover every
real C_i, and v_i^2 from -1 to 1.

Each square is divided into interval boxes. An interval box is a pair of intervals, one of x_1 and one of x_2. If the
interval of |Delta|^2 - |beta_i m_i|^2 excludes 0 for i = 1 or i = 2, the interval box has no zero. Otherwise Krawczyk's
test (Neumaier 1990) is tried. The test may prove that the interval box has no zero. Or it may prove that the enlarged
interval box, of twice the width, has exactly one zero. An interval box that is still undecided is divided into four.
Interval boxes that are undecided at the smallest width are reported.

The functions of a chart are computed in interval arithmetic and expanded to second order about the centre of an
interval box. The bound on the remainder holds in the enlarged interval box. Where the interval of Delta excludes 0, the
phases are unique.

A module is inactive if it is uncoupled and has no force. For an inactive module i, the condition x_i = 0 replaces the
condition |Delta|^2 - |beta_i m_i|^2 = 0. The function q_i, on which Delta and m_1, m_2 depend, is then set to 1.
"""

import functools
import itertools
import math
import sys
from dataclasses import dataclass

import numpy as np

from vibroimpact.studies.theory import asymmetric_points as asymmetric
from vibroimpact.studies.theory.branch import ASYMMETRIC, LARGE, SMALL, series
from vibroimpact.system.extras import need
from vibroimpact.theory.fixed_points.symmetric_points import search

need("reference", "flint")

from flint import acb, arb, arb_series, ctx  # noqa: E402 (after the dependency check)

SYMMETRIC_PAIRS = list(itertools.product((SMALL, LARGE), repeat=2))
_BITS = 128
_REACH = 2  # a tested interval box is enlarged by this factor, so that a zero on its edge is inside
_NARROWEST = 2.0**-24
_ISOLATED_WIDTH = 2.0**-20  # half-width to which the interval box around a zero is narrowed
_MOST = 20_000  # after this number of tests per pair of charts, no interval box is divided further
_TERMS = 30
# Remainder of the series in v^2 for |v^2| <= 2. The omitted terms and their derivatives are below 5^30 100^2 / 60!.
_TAIL = arb(0, 2.0**-150)
_ORDERS = 3
_REAL, _IMAGINARY = (np.frompyfunc(lambda z, part=part: getattr(z, part), 1, 1) for part in ("real", "imag"))

Box = tuple[tuple[float, float], ...]


@dataclass(frozen=True)
class Proof:
    """Result of the proof for the fixed points of a system, whose float64 hatted parameters are taken as exact.

    isolated: interval boxes in ascending order, each with exactly one fixed point. An interval box is a pair of
        intervals (lower end, upper end), one of C_1 and one of C_2. For asymmetric fixed points, each entry is (pair of
        charts, intervals of the parameters x_i) instead; see the module docstring. For a single machine, there is one
        interval instead of a pair of intervals, and one chart instead of a pair of charts.
    undecided: interval boxes in which nothing is proved, in the format of `isolated`. Outside the isolated and the
        undecided interval boxes, no fixed point exists for any real C_i and v_i^2 in [-1, 1].
    motions: number of isolated fixed points with C_i > 0 for each symmetric module and v_i^2 > 0 for each asymmetric
        module. A fixed point is not counted if one of its intervals contains 0.
    complete: True if nothing is undecided, and the numerical search finds exactly one fixed point per isolated entry.
    """

    isolated: list
    undecided: list
    motions: int
    complete: bool


def certify(system) -> Proof:
    """Prove how many fixed points a system has, with C_i of either sign.

    A system without forces has no fixed point, since no force compensates the dissipation mu rho C_i^2 of the impacts.
    Only a free motion with C_i = 0 could persist. If a system has such a free motion, `symmetric_points.search` raises
    ValueError.

    Raises
    ------
    ValueError
        As for `symmetric_points.search`.
    """
    listed = search(system)
    found, undecided = _all_zeros(system, SYMMETRIC_PAIRS)
    isolated = []
    for zero in sorted(_in_amplitudes(*zero) for zero in found):
        if not any(_same(zero, known) for known in isolated):  # a zero with |C_i| = 1 is found on two charts
            isolated.append(zero)
    open_boxes = [_in_amplitudes(pair, box) for pair, box in undecided]
    points = [_active(system, point.C) for point in listed]
    return _proof(isolated, open_boxes, isolated, _matched(isolated, points))


def certify_asymmetric(system) -> Proof:
    """Prove how many fixed points have an asymmetric module; mirror images count as one fixed point.

    Raises
    ------
    ValueError
        As for `asymmetric_points.search`.
    """
    listed = asymmetric.search(system)
    isolated, undecided = _all_zeros(system, asymmetric.PAIRS)
    places = [(_active(system, point.charts), _active(system, point.x)) for point in listed]
    matched = all(
        _matched([box for own, box in isolated if own == names], [x for own, x in places if own == names])
        for names in {own for own, _ in [*isolated, *places]}
    )
    return _proof(isolated, undecided, [box for _, box in isolated], matched)


def _proof(isolated, undecided, boxes, matched):
    motions = sum(all(low > 0 for low, _ in box) for box in boxes)
    return Proof(isolated, undecided, motions, matched and not undecided)


def _matched(boxes, points):
    """Return True if each interval box contains exactly one point, and each point is in exactly one interval box."""
    inside = [[all(low <= x <= high for (low, high), x in zip(box, at, strict=True)) for at in points] for box in boxes]
    counts = np.reshape(inside, (len(boxes), len(points)))
    return bool((counts.sum(axis=0) == 1).all() and (counts.sum(axis=1) == 1).all())


def _in_amplitudes(pair, box) -> Box:
    """Return the intervals of C_i that correspond to the intervals `box` of x_i.

    On the chart SMALL, x_i is C_i. On the chart LARGE, x_i is 1 / C_i.
    """
    ends = []
    for name, (low, high) in zip(pair, box, strict=True):
        if name == LARGE:
            across = low <= 0 <= high
            low, high = (-math.inf, math.inf) if across else (math.nextafter(1 / high, -math.inf), 1 / low)
        ends.append((low, math.nextafter(high, math.inf) if name == LARGE else high))
    return tuple(ends)


def _same(box, known):
    """Return True if the inner half of an interval box, where its zero lies, is inside the interval box `known`."""
    shrunk = [((3 * low + high) / 4, (low + 3 * high) / 4) for low, high in box]
    return all(low >= a and high <= b for (low, high), (a, b) in zip(shrunk, known, strict=True))


def _all_zeros(system, pairs):
    """Return the interval boxes with exactly one zero, and the undecided interval boxes.

    Each entry is (charts of the active modules, interval box). Zeros outside the square |x_i| <= 1 are left out.
    """
    found, undecided = [], []
    with ctx.workprec(_BITS):
        for pair in asymmetric.pairs_of(system, pairs):
            zeros, unclear = _subdivide(_Conditions(system, pair))
            inside = [box for box in zeros if all(low <= 1 and high >= -1 for low, high in box)]
            for boxes, kept in ((inside, found), (unclear, undecided)):
                kept += [(_active(system, pair), _active(system, box)) for box in boxes]
    return found, undecided


def _active(system, both) -> tuple:
    """Return the entries of `both` that belong to active modules; `both` has one entry per module."""
    return tuple(both[module - 1] for module in system.modules)


def _subdivide(conditions):
    """Divide the square |x_i| <= 1; return the interval boxes with exactly one zero, and those left undecided."""
    pending, found, undecided = [(0.0, 0.0, 1.0)], [], []  # half-widths are powers of two, so that centres are exact
    for visited in itertools.count():
        if not pending:
            break
        x, y, half = pending.pop()
        zeros, _ = conditions.count(x, y, half)
        if zeros == 0:
            continue
        zero = _narrowed(conditions, x, y, half) if zeros == 1 else None
        if zero is not None:
            found.append(zero)
        elif half <= _NARROWEST or visited >= _MOST:
            undecided.append((x, y, half / _REACH))
        else:
            half /= 2
            pending += [(x + i * half, y + j * half, half) for i in (-1, 1) for j in (-1, 1)]
    distinct = []
    for zero in sorted(found):
        gaps = [max(abs(zero[0] - x), abs(zero[1] - y)) / half for x, y, half in distinct]
        # Zeros this close are the same zero, since the enlarged interval box of a zero contains no other zero.
        if any(gap < 0.5 for gap in gaps):
            continue
        (undecided if any(gap < 2 * _REACH for gap in gaps) else distinct).append(zero)
    return [_box(*zero) for zero in distinct], [_box(*zero) for zero in undecided]


def _narrowed(conditions, x, y, half):
    """Return (centre x, centre y, half-width) of a small interval box about the only zero in a wide interval box.

    x, y, half: centre and half-width of the wide interval box.

    If the wide interval box cannot be narrowed, return None. If the phases at the zero are not proved unique, return
    None too.
    """
    while half > _ISOLATED_WIDTH:
        _, (x, y, half) = conditions.count(x, y, half)
        half = max(half, _ISOLATED_WIDTH)
        if conditions.count(x, y, half)[0] != 1:
            return None
    delta = conditions.sides(x, y, _REACH * half)[0]
    return (x, y, half) if _excludes_zero(delta) else None


def _box(x, y, half) -> Box:
    reach = _REACH * half
    return (x - reach, x + reach), (y - reach, y + reach)


class _Conditions:
    """The conditions |Delta|^2 - |beta_i m_i|^2 = 0 in one pair of charts, as polynomials on an interval box.

    The variables of the polynomials are t_i = (x_i - centre_i) / half, with the centre and the half-width of the
    interval box. The polynomials are valid for |t_i| <= _REACH. A polynomial is an array of intervals: entry [j, k] is
    the coefficient of t_1^j t_2^k.
    """

    def __init__(self, system, pair):
        self.kappa, self.names = arb(system.kappa), pair
        self.f = arb(system.f10_hat), arb(system.f20_hat)
        sigma = -2 * arb(system.sigma_e_hat)
        self.e = acb(sigma, system.gamma1_hat), acb(sigma + arb(system.sigma20_hat), system.gamma2_hat)
        self.K = acb(system.alpha12_hat, system.gamma12_hat)
        self._idle = [i for i in range(2) if i + 1 not in system.modules]
        self._chart = functools.lru_cache(maxsize=None)(self._expanded)

    def count(self, x, y, half):
        """Return the number of zeros in an interval box (0, 1 or None), and an interval box around a single zero.

        x, y, half: centre and half-width of the interval box.

        The number None means that the number of zeros is undecided. The number 1 means that the interval box, enlarged
        by the factor _REACH, has exactly one zero. Then the second result is (centre x, centre y, half-width) of an
        interval box that contains this zero. Otherwise the second result is None.
        """
        delta, one, two = self.sides(x, y, half)
        local = np.array([delta - one, delta - two])
        for i in self._idle:
            local[i] = arb(0)
            local[i, 0, 0], local[(i, *np.eye(2, dtype=int)[i])] = arb((x, y)[i]), arb(half)
        if any(_excludes_zero(polynomial) for polynomial in local):
            return 0, None
        (a, b), (c, d) = (map(float, (polynomial[1, 0], polynomial[0, 1])) for polynomial in local)
        if (determinant := a * d - b * c) == 0:
            return None, None
        # The test uses the map t - Y F(t) with F = `local` and Y = `inverse`. The constant term of the map is -Y F(0).
        # For |t_i| <= s, `_size` bounds the sum of all other terms of the map.
        inverse = np.array([[d, -b], [-c, a]]) / determinant
        mapped = np.tensordot(inverse.astype(object), local, 1)
        mapped[0, 1, 0] -= 1
        mapped[1, 0, 1] -= 1
        if any(abs(g[0, 0]) > 1 + _size(g, 1) for g in mapped):
            return 0, None
        maps = all(abs(g[0, 0]) + _size(g, _REACH) < _REACH for g in mapped)
        if not (maps and all(_slope(g, _REACH) < 1 for g in mapped)):
            return None, None
        centre = [float(-g[0, 0].mid()) * half for g in mapped]
        radius = max(float((_size(g, _REACH) + g[0, 0].rad()).upper()) for g in mapped) * half
        rounding = 4 * sys.float_info.epsilon * (abs(x) + abs(y) + half)
        return 1, (x + centre[0], y + centre[1], radius + rounding)

    def sides(self, x, y, half):
        """Return |Delta|^2, |beta_1 m_1|^2 and |beta_2 m_2|^2 as polynomials on an interval box."""
        (z1, q1, beta1, n2), (z2, q2, beta2, n1) = (self._chart(i, at, half) for i, at in enumerate((x, y)))
        delta = np.multiply.outer(q1, q2 + self.K * z2) + np.multiply.outer(self.K * z1, q2)
        return _modulus_squared(delta), np.multiply.outer(beta1, n1), np.multiply.outer(n2, beta2)

    def _expanded(self, module, at, half):
        """Return z, q = e z + n, beta^2 and |m|^2 as polynomials in t = (x - at) / half.

        z, q and beta belong to `module`. m belongs to the other module and is a function of z and q.

        The highest coefficients of z, q, beta and m include the remainder for |t| <= _REACH.
        """
        exact, wide = (_functions(self.names[module], arb(at, radius), self.kappa) for radius in (0, _REACH * half))
        powers = [arb(half) ** k for k in range(_ORDERS)]
        real, imaginary, n, beta = (np.array([*a[:2], b[2]]) * powers for a, b in zip(exact, wide, strict=True))
        z = real + acb(0, 1) * imaginary
        q = np.array([acb(1), acb(0), acb(0)]) if module in self._idle else self.e[module] * z + n
        numerator = self.f[1 - module] * q + sum(self.f) * self.K * z
        return z, q, _modulus_squared(beta * acb(1)), _modulus_squared(numerator)


def _functions(name, at, kappa):
    """Return the Taylor coefficients of Re z, Im z, n and beta of a chart, at a point or over an interval."""
    pi = arb.pi()
    rho, mu, x = 2 * (1 - kappa) / (pi * (1 + kappa)), 8 / pi**2, arb_series([at, 1], prec=_ORDERS)
    one = arb_series([1], prec=_ORDERS)
    if name == ASYMMETRIC:
        c, s = (_evaluated(coefficients, x) for coefficients in _series())
        functions = -4 / pi**2 * c, -rho * s, mu * c * c * s, ((1 - x) * s - 4 / pi**2 * c) * c
    else:
        functions = {SMALL: (1 - x, -rho * x, mu * x, one), LARGE: (x - 1, -rho * one, mu * one, x)}[name]
    return [[function[k] for k in range(_ORDERS)] for function in functions]


@functools.cache
def _series():
    return series(_TERMS, arb.pi())


def _evaluated(coefficients, x):
    value = arb_series([0], prec=_ORDERS)
    for coefficient in reversed(coefficients):
        value = value * x + coefficient
    return value + arb_series([_TAIL] * _ORDERS, prec=_ORDERS)


def _modulus_squared(polynomial):
    """Return the coefficients of |polynomial|^2 in one or two variables."""
    real, imaginary = _REAL(polynomial), _IMAGINARY(polynomial)
    square = np.full(2 * np.array(polynomial.shape) - 1, arb(0))
    for place in np.ndindex(polynomial.shape):
        window = tuple(slice(k, k + size) for k, size in zip(place, polynomial.shape, strict=True))
        square[window] += real[place] * real + imaginary[place] * imaginary
    return square


def _excludes_zero(polynomial):
    """Return True if the constant term is larger in modulus than all other terms together for |t| <= 1."""
    return abs(polynomial[0, 0]) > _size(polynomial, 1)


def _size(polynomial, reach):
    """Return a bound on the sum of all terms except the constant term for |t| <= reach."""
    return (abs(polynomial) * reach ** _degrees(polynomial)).ravel()[1:].sum()


def _slope(polynomial, reach):
    """Return a bound on |dp/dt_1| + |dp/dt_2| of a polynomial p for |t| <= reach."""
    degrees = _degrees(polynomial)
    return (degrees * abs(polynomial) * reach ** np.maximum(degrees - 1, 0)).sum()


def _degrees(polynomial):
    return np.add.outer(*map(np.arange, polynomial.shape))
