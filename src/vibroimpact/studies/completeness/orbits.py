"""Prove in interval arithmetic (python-flint's arb) that the list of symmetric 1:1 responses is complete.

The equations of symmetric.py are P(delta) C + i (1, 1) = (a_1 exp(i phi), a_2 exp(i (phi + Omega delta))). The ball of
module j hits wall +1 at tau_j. The lag is delta = tau_2 - tau_1, the phase is phi = Omega tau_1, and the forced
amplitudes are a_j. The complex matrix P has the rows P_1 and P_2. Elimination of phi leaves one complex equation,
linear in the real C_1 and C_2,

    (w_2 P_1 - w_1 P_2) . C = i (w_1 - w_2),        w_1 = a_1,  w_2 = a_2 exp(i Omega delta),

so C = N(delta) / D(delta) by Cramer's rule. Let k be the module with the larger |a_k|. The modulus of equation k gives
one equation for delta alone,

    F(delta) = |P_k . N + i D|^2 - |a_k|^2 D^2 = 0.

Where D is not 0, the roots of F are exactly the solutions, each with one C and one phase. F is smooth on [0, T/2] and
on [T/2, T], where T is the forcing period. Both halves of the period are bisected until every interval is decided. An
enclosure is an interval that contains all values of a function. If the enclosure of F excludes 0, F has no root in the
interval of delta. If the enclosures of F' and D exclude 0, F is monotonic. Then its signs at the two ends show whether
F has one root or none. The proof covers any lag, any phase and any real C. Undecided intervals of the smallest width
are reported. They occur, for example, at a double root of F, or at a root at delta = T/2, where F has a kink.

For a single machine, |P_kk C_k + i| = |a_k| is a quadratic equation for C_k.
"""

import itertools
import math
from dataclasses import dataclass

import numpy as np

from vibroimpact.exact.orbits.proof.conditions import SteadyBoxes
from vibroimpact.exact.orbits.symmetric import symmetric_solutions, wrapped
from vibroimpact.system.extras import need

need("reference", "flint")

from flint import acb, acb_series, arb, arb_series  # noqa: E402 (after the dependency check)

_NARROWEST = 2.0**-24  # smallest width of an interval of delta / (T/2), far above the rounding errors of arb
_FIRST = 8
_MOST = 10_000  # largest number of intervals that are examined; the remaining ones are reported as undecided
_TERMS = 3


@dataclass(frozen=True)
class Proof:
    """Result of the proof for the symmetric orbits of a system, whose float64 parameters are taken as exact.

    isolated: ascending intervals with exactly one symmetric response each. They are intervals of the lag
        (tau_2 - tau_1) / T, or of C for a single machine.
    undecided: intervals in which nothing is proved. Outside the isolated and the undecided intervals, no symmetric
        response exists.
    complete: True if nothing is undecided, and `symmetric_solutions` lists exactly one response per isolated interval.
    """

    isolated: list[tuple[float, float]]
    undecided: list[tuple[float, float]]
    complete: bool


def certify(system) -> Proof:
    """Prove how many symmetric 1:1 responses a system has, including those that are not admissible.

    A system without forcing has no symmetric 1:1 response.

    Raises
    ------
    ValueError
        If the boxes have an undamped resonance at a harmonic of the impacts.
    """
    listed = symmetric_solutions(system)
    if system.modules == (1, 2):
        isolated, undecided = _bisect(_Condition(system))
        places = np.sort(wrapped(listed[:, 1] - listed[:, 0], system.period) / system.period)
    else:
        (isolated, undecided), places = _of_one_module(system), np.sort(listed[:, 2:].sum(axis=1))
    matched = len(places) == len(isolated) and all(a <= x <= b for (a, b), x in zip(isolated, places, strict=True))
    return Proof(isolated, undecided, matched and not undecided)


def _of_one_module(system):
    """Return the intervals of C with exactly one symmetric response, and the undecided intervals, both ascending."""
    if not system.modules:
        return [], []
    i, condition = system.modules[0] - 1, _Condition(system)
    P, force = condition._own(i)[0], abs(condition.amplitude[i])
    square = abs(P) ** 2
    middle, discriminant = -P.imag / square, square * force**2 - P.real**2
    if discriminant < 0:
        return [], []
    away = abs(discriminant).sqrt() / square
    if not discriminant > 0:
        return [], [(float((middle - away).lower()), float((middle + away).upper()))]
    roots = middle - away, middle + away
    return [(float(root.mid() - away / 2), float(root.mid() + away / 2)) for root in roots], []


def _bisect(condition):
    """Return the intervals of delta / T with exactly one root of F, and the undecided intervals, both ascending."""
    pending = [(half, k / _FIRST, (k + 1) / _FIRST) for half in (0, 1) for k in range(_FIRST)]
    isolated, undecided = [], []
    for visited in itertools.count():
        if not pending:
            return sorted(isolated), sorted(undecided)
        half, lower, upper = pending.pop()
        roots = condition.count(lower, upper, half) if visited < _MOST else None
        lag = ((lower + half) / 2, (upper + half) / 2)
        if roots == 1:
            isolated.append(lag)
        elif roots is None and (upper - lower <= _NARROWEST or visited >= _MOST):
            undecided.append(lag)
        elif roots is None:
            middle = (lower + upper) / 2
            pending += [(half, lower, middle), (half, middle, upper)]


class _Condition:
    """The functions F and D of the lag delta (see the module docstring), with their derivatives, on intervals."""

    def __init__(self, system):
        boxes = SteadyBoxes(system, sign=-1)
        self.half_period, self.rate, self.start, self.omega = boxes.period / 2, boxes.rate, boxes.start, boxes.omega
        epsilon, kappa = arb(system.epsilon), arb(system.kappa)
        self.place = 1 / (1 + epsilon)
        self.kick = 4 * epsilon * self.place / self.half_period
        self.own_velocity = 2 * self.place / self.half_period * (1 + 2 * epsilon - kappa) / (1 + kappa)
        self.amplitude = boxes.amplitude[0, 0], boxes.amplitude[1, 0]
        self.larger = int(abs(self.amplitude[1]).mid() > abs(self.amplitude[0]).mid())

    def count(self, lower, upper, half):
        """Return the number of roots of F in an interval of delta: 0, 1, or None if the number is undecided.

        The interval is (half + [lower, upper]) T/2, where T is the forcing period and `half` is 0 or 1.
        """
        radius = (upper - lower) / 2
        step = arb(0, radius) * self.half_period
        F0, _ = self._at(arb((lower + upper) / 2), half)
        F, D = self._at(arb((lower + upper) / 2, radius), half)
        slope = F0[1] + 2 * F[2] * step
        if not (F0[0] + slope * step).contains(0):
            return 0
        ends = [self._at(arb(end), half)[0][0] for end in (lower, upper)]
        if slope.contains(0) or D[0].contains(0) or any(end.contains(0) for end in ends):
            return None
        return int((ends[0] > 0) != (ends[1] > 0))

    def _at(self, position, half):
        """Return the Taylor coefficients of orders 0, 1 and 2 of F and of D at delta = (half + position) T/2.

        half: 0 for the first and 1 for the second half of the forcing period T.
        position: a number or an interval in [0, 1].
        """
        sign = 1 - 2 * half
        forward = (self.rate * (self.half_period * position)).exp() * self.start
        backward = (self.rate * (self.half_period * (1 - position))).exp() * self.start
        lag = self._entry([sign * term for term in self._taylor(forward, 1)], row=1, column=0)
        lead = self._entry([-sign * term for term in self._taylor(backward, -1)], row=0, column=1)
        P1, P2 = (self._own(0), lead), (lag, self._own(1))
        turn = (acb(0, 1) * arb.pi() * position).exp()
        rates = [(acb(0, 1) * self.omega) ** k / math.factorial(k) for k in range(_TERMS)]
        w1, w2 = self.amplitude[0], _series([sign * self.amplitude[1] * turn * rate for rate in rates])
        (a, b), (c, d) = (_parts(w2 * P1[k] - w1 * P2[k]) for k in range(2))
        e, f = _parts((w1 - w2) * acb(0, 1))
        D, N1, N2 = a * d - b * c, e * d - f * c, a * f - b * e
        (x, y), (u, v) = (_parts(entry) for entry in (P1, P2)[self.larger])
        F = (x * N1 + u * N2) ** 2 + (y * N1 + v * N2 + D) ** 2 - abs(self.amplitude[self.larger]) ** 2 * D**2
        return _coefficients(F), _coefficients(D)

    def _taylor(self, motion, direction):
        """Return the Taylor coefficients of a free motion of the boxes.

        motion: coefficient of order 0, which is the state of the boxes.
        direction: 1 for forward time, -1 for backward time.
        """
        terms = [motion]
        for k in range(1, _TERMS):
            terms.append(self.rate * terms[-1] * (arb(direction) / k))
        return terms

    def _entry(self, terms, row, column):
        """Return the entry P[row, column] outside the diagonal.

        terms: Taylor coefficients of the response of the boxes to the impacts of ball `column`.
        """
        return _series([self.kick * acb(m[2 + row, column] / self.omega, m[row, column]) for m in terms])

    def _own(self, i):
        """Return the diagonal entry P[i, i], computed from the state of box i just before an impact of ball i."""
        velocity = self.own_velocity + self.kick * (self.start[2 + i, i] - 1)
        return _series([acb(velocity / self.omega, self.kick * self.start[i, i] - self.place)])


def _series(coefficients):
    return acb_series(coefficients, prec=_TERMS)


def _parts(series):
    """Return the real and imaginary part of a series in a real variable."""
    coefficients = series.coeffs()
    return (arb_series([getattr(c, part) for c in coefficients], prec=_TERMS) for part in ("real", "imag"))


def _coefficients(series):
    return [*series.coeffs(), *[arb(0)] * _TERMS][:_TERMS]
