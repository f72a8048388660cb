"""Proof that the list of asymmetric fixed points is complete, in interval arithmetic (python-flint's arb).

The conditions |Delta|^2 = |beta_1 n_1|^2 = |beta_2 n_2|^2 on each pair of charts, over the whole square |x_i| <= 1:
every real C_i, and v^2 from -1 to 1 (docs/derivation.md, section 11). Boxes are counted as for symmetric points; the
functions of a chart are expanded to second order about the centre of a box, the second order enclosed over its reach.
"""

import functools
from dataclasses import dataclass

from vibroimpact.system.extras import need
from vibroimpact.theory.asymmetric.charts import ASYMMETRIC, LARGE, SMALL, series
from vibroimpact.theory.asymmetric.search import PAIRS, search
from vibroimpact.theory.fixed_points.certify import (
    BITS,
    REACH,
    Box,
    Conditions,
    matched,
    minus,
    modulus_squared,
    subdivide,
)

need("reference", "flint")

from flint import acb, arb, arb_series, ctx  # noqa: E402 (after the word on what is missing)

_TERMS = 30
_TAIL = arb(0, 2.0**-150)  # for |v^2| <= 2: the terms left out, and their derivatives, are below 5^30 100^2 / 60!
_ORDERS = 3


@dataclass(frozen=True)
class Proof:
    """What is proved of a system whose hatted parameters are the float64 numbers that the code holds.

    isolated: pairs of charts and the boxes of their parameters, each with exactly one fixed point.
    undecided: the same, where nothing is proved; everywhere else there is none with v^2 in [-1, 1].
    motions: how many of the isolated points are motions at leading order, C_i > 0 and v_i^2 > 0; a box across 0 is not
        counted. On the asymmetric branch C is positive anyway.
    complete: nothing is undecided, and `search` lists exactly one point in each isolated box.
    """

    isolated: list[tuple[tuple[str, str], Box]]
    undecided: list[tuple[tuple[str, str], Box]]
    motions: int
    complete: bool


def certify(system) -> Proof:
    """Prove how many fixed points with an asymmetric module a system has, mirror images counted once.

    Raises:
        ValueError: as `search`.
    """
    listed = search(system)
    if system.has_undriven_module:
        return Proof([], [], 0, not listed)
    isolated, undecided, complete = [], [], True
    with ctx.workprec(BITS):
        for pair in PAIRS:
            found, unclear = subdivide(_Balance(system, pair))
            found = [box for box in found if _meets(box)]
            complete &= not unclear and matched(found, [point.x for point in listed if point.charts == pair])
            isolated += [(pair, box) for box in found]
            undecided += [(pair, box) for box in unclear]
    motions = sum(all(low > 0 for low, _ in box) for _, box in isolated)
    return Proof(isolated, undecided, motions, complete)


def _meets(box):
    """Whether a box meets the square; a zero that is found beyond its edge is none."""
    return all(low <= 1 and high >= -1 for low, high in box)


class _Balance(Conditions):
    """The two conditions in one pair of charts."""

    radius = 1.0

    def __init__(self, system, pair):
        self.kappa, self.names = arb(system.kappa), pair
        self.f = arb(system.f10_hat), arb(system.f20_hat)
        sigma = -2 * arb(system.sigma_e_hat)
        self.e = acb(sigma, system.gamma1_hat), acb(sigma + arb(system.sigma20_hat), system.gamma2_hat)
        self.K = acb(system.alpha12_hat, system.gamma12_hat)
        self._chart = functools.lru_cache(maxsize=None)(self._expanded)

    def pair(self, x, y, half):
        delta, one, two = self._sides(x, y, half)
        return minus(delta, one), minus(delta, two)

    def denominator(self, x, y, half):
        return self._sides(x, y, half)[0]

    def _sides(self, x, y, half):
        """Local |Delta|^2, |beta_1 n_1|^2 and |beta_2 n_2|^2."""
        (z1, q1, beta1, n2), (z2, q2, beta2, n1) = (self._chart(i, at, half) for i, at in enumerate((x, y)))
        row = [q + self.K * z for q, z in zip(q2, z2, strict=True)]
        delta = [[a * b + z * self.K * q for b, q in zip(row, q2, strict=True)] for a, z in zip(q1, z1, strict=True)]
        return modulus_squared(delta), _outer(beta1, n1), _outer(n2, beta2)

    def _expanded(self, module, at, half):
        """Coefficients of z, q = e z + n, beta^2 and |n_j|^2, j the other module, in t = (x - at) / half.

        The highest of z, q and beta and of the numerator n_j are enclosed for |t| <= REACH.
        """
        exact, wide = (_functions(self.names[module], arb(at, radius), self.kappa) for radius in (0, REACH * half))
        real, imaginary, n, beta = (
            [acb(term) * arb(half) ** k for k, term in enumerate([*one[:2], all_of[2]])]
            for one, all_of in zip(exact, wide, strict=True)
        )
        z = [a + acb(0, 1) * b for a, b in zip(real, imaginary, strict=True)]
        q = [self.e[module] * a + b for a, b in zip(z, n, strict=True)]
        numerator = [self.f[1 - module] * a + sum(self.f) * self.K * b for a, b in zip(q, z, strict=True)]
        return z, q, modulus_squared([beta])[0], modulus_squared([numerator])[0]


def _functions(name, at, kappa):
    """Taylor coefficients at a point, or over an interval, of Re z, Im z, n and beta of a chart."""
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


def _outer(one, other):
    return [[a * b for b in other] for a in one]
