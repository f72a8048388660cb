"""Proof that the list of fixed points is complete, in interval arithmetic (python-flint's arb).

Fixed points are the common real zeros of |Delta|^2 - |n_1|^2 and |n_2|^2 - |n_1|^2, of degree 2 in each of C_1 and C_2
(docs/derivation.md, section 5), and none lies outside a disc (section 6). The square around the disc is quartered until
in each box a polynomial excludes 0 or a contraction settles how many zeros there are: none, or exactly one in the box
of twice the width (Krawczyk's test; Neumaier 1990). Coefficients are formed anew from the parameters, in intervals.
Where Delta excludes 0 the phases follow uniquely. What stays open at the smallest width is reported.
"""

import itertools
import math
import sys
from dataclasses import dataclass

import numpy as np

from vibroimpact.system.extras import need
from vibroimpact.theory.fixed_points.search import search

need("reference", "flint")

from flint import acb, arb, ctx  # noqa: E402 (after the word on what is missing)

BITS = 128
REACH = 2  # a box is tested at this many times its width, so that zeros on an edge are settled
_NARROWEST = 2.0**-24
_KNOWN = 2.0**-20  # half-width at which a zero is known well enough to be told from the others
_MOST = 20_000  # boxes to look at: the rest is reported as undecided

Box = tuple[tuple[float, float], tuple[float, float]]


@dataclass(frozen=True)
class Proof:
    """What is proved of a system whose hatted parameters are the float64 numbers that the code holds.

    isolated: boxes ((C_1 from, to), (C_2 from, to)), disjoint, each with exactly one fixed point, ascending.
    undecided: boxes in which nothing is proved; everywhere else, for any real C_i, there is no fixed point.
    complete: nothing is undecided, and `search` lists exactly one point in each isolated box.
    """

    isolated: list[Box]
    undecided: list[Box]
    complete: bool


def certify(system) -> Proof:
    """Prove how many fixed points a system has, C_i of either sign.

    There is none where a module is driven by nothing: what its ball dissipates, mu rho C_i^2, leaves C_i = 0, and
    `search` refuses the free motion that would be left.

    Raises:
        ValueError: as `fixed_points.search`.
    """
    listed = search(system)
    with ctx.workprec(BITS):
        isolated, undecided = ([], []) if system.has_undriven_module else subdivide(_Balance(system))
    points = [point.C for point in listed.points + listed.outside]
    return Proof(isolated, undecided, matched(isolated, points) and not undecided)


def matched(isolated, points) -> bool:
    """Whether each box holds one of the points and each point is in one box."""
    counts = np.array([[_holds(box, point) for point in points] for box in isolated], dtype=int)
    counts = counts.reshape(len(isolated), len(points))
    one_each = (counts.sum(axis=0) == 1).all() and (counts.sum(axis=1) == 1).all()
    return len(points) == len(isolated) and bool(one_each)


def _holds(box, C):
    return all(low <= c <= high for (low, high), c in zip(box, C, strict=True))


def subdivide(balance):
    """Boxes with exactly one zero of a system of Conditions, and those that stay open."""
    # Powers of two, so that centres are exact.
    pending = [(0.0, 0.0, 2.0 ** math.ceil(math.log2(balance.radius)))]
    found, undecided = [], []
    for visited in itertools.count():
        if not pending:
            break
        x, y, half = pending.pop()
        zeros, _ = balance.count(x, y, half)
        if zeros == 0:
            continue
        zero = _narrowed(balance, x, y, half) if zeros == 1 else None
        if zero is not None:
            found.append(zero)
        elif half <= _NARROWEST or visited >= _MOST:
            undecided.append((x, y, half))
        else:
            half /= 2
            pending += [(x + i * half, y + j * half, half) for i in (-1, 1) for j in (-1, 1)]
    distinct, unclear = _distinct(sorted(found))
    return [_box(*zero) for zero in distinct], [_box(x, y, half / REACH) for x, y, half in undecided + unclear]


def _narrowed(balance, x, y, half):
    """Centre and half-width of a small box about the zero of a wide one, or None where it cannot be made small."""
    while half > _KNOWN:
        _, (x, y, half) = balance.count(x, y, half)
        half = max(half, _KNOWN)
        if balance.count(x, y, half)[0] != 1:
            return None
    return (x, y, half) if balance.phases_follow(x, y, half) else None


def _distinct(zeros):
    """One of each group of boxes about the same zero, and those of which it is not clear whether they are."""
    distinct, unclear = [], []
    for zero in zeros:
        gaps = [max(abs(zero[0] - x), abs(zero[1] - y)) / half for x, y, half in distinct]
        if any(gap < 0.5 for gap in gaps):  # within the reach of the first box, where it has one zero only
            continue
        (unclear if any(gap < 2 * REACH for gap in gaps) else distinct).append(zero)
    return distinct, unclear


def _box(x, y, half) -> Box:
    reach = REACH * half
    return (x - reach, x + reach), (y - reach, y + reach)


class Conditions:
    """Two equations in (x, y), expanded about the centre of a box; what is said holds for all |t| <= REACH there.

    A subclass has `radius`, the half-width of the square to look at, and the local polynomials with intervals as
    coefficients, entry [j][k] belonging to t_1^j t_2^k: `pair`(x, y, half) of both equations, `denominator`(x, y, half)
    of |Delta|^2. Coefficients of the highest powers may enclose a remainder.
    """

    def count(self, x, y, half):
        """Zeros in the box of this half-width about (x, y): 0 none, 1 exactly one in REACH times it, or None.

        With 1, also centre and half-width of a box around the zero.
        """
        local = self.pair(x, y, half)
        if any(_excludes_zero(polynomial) for polynomial in local):
            return 0, None
        inverse = _inverse([[float(polynomial[1][0]), float(polynomial[0][1])] for polynomial in local])
        if inverse is None:
            return None, None
        # t - Y F(t) maps the box |t| <= s into -Y F(0) plus or minus what the other terms can add.
        mapped = [_combine(row, local) for row in inverse]
        for own, polynomial in enumerate(mapped):
            polynomial[1 - own][own] -= 1
        if any(abs(g[0][0]) > 1 + _size(g, 1) for g in mapped):
            return 0, None
        maps = all(abs(g[0][0]) + _size(g, REACH) < REACH for g in mapped)
        if not (maps and all(_slope(g, REACH) < 1 for g in mapped)):
            return None, None
        centre = [float(-g[0][0].mid()) * half for g in mapped]
        radius = max(float((_size(g, REACH) + g[0][0].rad()).upper()) for g in mapped) * half
        rounding = 4 * sys.float_info.epsilon * (abs(x) + abs(y) + half)
        return 1, (x + centre[0], y + centre[1], radius + rounding)

    def phases_follow(self, x, y, half):
        """Whether Delta is not 0 near (x, y), so that the phases are those of n_i / Delta."""
        return _excludes_zero(self.denominator(x, y, REACH * half))


class _Balance(Conditions):
    """The two polynomials and |Delta|^2 with intervals as coefficients; entry [j][k] belongs to C_1^j C_2^k."""

    def __init__(self, system):
        pi = arb.pi()
        kappa, f1, f2 = arb(system.kappa), arb(system.f10_hat), arb(system.f20_hat)
        rho, mu = 2 * (1 - kappa) / (pi * (1 + kappa)), 8 / pi**2
        sigma = -2 * arb(system.sigma_e_hat)
        e = acb(sigma, system.gamma1_hat), acb(sigma + arb(system.sigma20_hat), system.gamma2_hat)
        K = acb(system.alpha12_hat, system.gamma12_hat)
        z = acb(1), acb(-1, -rho)
        q1, q2 = ([own * z[0], own * z[1] + mu] for own in e)
        delta = [[q1[j] * q2[k] + K * (z[j] * q2[k] + q1[j] * z[k]) for k in (0, 1)] for j in (0, 1)]
        n1 = [[f1 * q2[k] + (f1 + f2) * K * z[k] for k in (0, 1)], [acb(0), acb(0)]]
        n2 = [[f2 * q1[j] + (f1 + f2) * K * z[j], acb(0)] for j in (0, 1)]
        self._delta, one, two = (modulus_squared(polynomial) for polynomial in (delta, n1, n2))
        self._pair = minus(self._delta, one), minus(two, one)
        grow = ((1 + rho**2) * (f1**2 + f2**2)).sqrt()
        self.radius = float(((grow + (grow**2 + 4 * mu * rho * (abs(f1) + abs(f2))).sqrt()) / (2 * mu * rho)).upper())

    def pair(self, x, y, half):
        return [_about(polynomial, x, y, half) for polynomial in self._pair]

    def denominator(self, x, y, half):
        return _about(self._delta, x, y, half)


def modulus_squared(polynomial):
    """Coefficients of |polynomial|^2."""
    sizes = 2 * len(polynomial) - 1, 2 * len(polynomial[0]) - 1
    square = [[arb(0)] * sizes[1] for _ in range(sizes[0])]
    for (j, k, a), (m, n, b) in itertools.product(_terms(polynomial), repeat=2):
        square[j + m][k + n] += a.real * b.real + a.imag * b.imag
    return square


def minus(one, other):
    """Coefficients of the difference of two polynomials of the same degrees."""
    return [[a - b for a, b in zip(*rows, strict=True)] for rows in zip(one, other, strict=True)]


def _about(polynomial, x, y, half):
    """Coefficients in (C - centre) / half."""
    rows = [_shifted(row, y, half) for row in polynomial]
    columns = [_shifted(column, x, half) for column in zip(*rows, strict=True)]
    return [list(row) for row in zip(*columns, strict=True)]


def _shifted(coefficients, centre, half):
    a, b, c = coefficients
    centre, half = arb(centre), arb(half)
    return a + centre * (b + centre * c), half * (b + 2 * centre * c), half * half * c


def _excludes_zero(polynomial):
    """Whether the constant term outweighs all others for |t| <= 1."""
    return abs(polynomial[0][0]) > _size(polynomial, 1)


def _size(polynomial, reach):
    """Bound on all terms but the constant one for |t| <= reach."""
    return sum((abs(value) * reach ** (j + k) for j, k, value in _terms(polynomial) if j or k), arb(0))


def _slope(polynomial, reach):
    """Bound on the sum of both derivatives for |t| <= reach."""
    return sum(((j + k) * abs(value) * reach ** (j + k - 1) for j, k, value in _terms(polynomial) if j or k), arb(0))


def _terms(polynomial):
    return ((j, k, value) for j, row in enumerate(polynomial) for k, value in enumerate(row))


def _inverse(matrix):
    (a, b), (c, d) = matrix
    determinant = a * d - b * c
    if determinant == 0:
        return None
    return [[d / determinant, -b / determinant], [-c / determinant, a / determinant]]


def _combine(weights, polynomials):
    one, two = polynomials
    return [
        [weights[0] * a + weights[1] * b for a, b in zip(*rows, strict=True)] for rows in zip(one, two, strict=True)
    ]
