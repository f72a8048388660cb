"""How long a constraint certainly holds, and when it certainly ends.

A constraint is a smooth g(t) >= 0 (the gap to a wall, or the contact force of a sticking ball). With its Taylor
polynomial of degree 6 and a bound on its seventh derivative it stays above a polynomial c (8,), c0 + ... + c7 t^7, and
that is positive on [0, T] if its coefficients in the Bernstein basis of [0, T] are (conservative advancement: repeated
from the safe side, the times T converge to the first zero of g and never pass it). Where the rate of g certainly keeps
its sign there is one zero at most, and it may be sought from either side.

The tests are carried out in floating point. Callers lower c0 by a margin, the rounding of all that g is made of, and
"certain" means: by these tests, with that margin.
"""

import math

from vibroimpact.exact.engine.compiled import inlined
from vibroimpact.exact.engine.flow import half_curvature, slope, value

MOMENT = 1e-300  # times do not go on shrinking below it


@inlined
def least(c, t):
    """A lower bound of the polynomial c (8,) on [0, t]: its least coefficient in the Bernstein basis."""
    t2 = t * t
    t3, t4 = t2 * t, t2 * t2
    b = (
        c[0],
        c[1] * t * (1 / 7),
        c[2] * t2 * (1 / 21),
        c[3] * t3 * (1 / 35),
        c[4] * t4 * (1 / 35),
        c[5] * (t2 * t3) * (1 / 21),
        c[6] * (t3 * t3) * (1 / 7),
        c[7] * (t3 * t4),
    )
    low = c[0]
    for _ in range(7):  # the k-th coefficient is the sum of the first with Pascal's k-th row as weights
        b = (b[0] + b[1], b[1] + b[2], b[2] + b[3], b[3] + b[4], b[4] + b[5], b[5] + b[6], b[6] + b[7], b[7])
        low = low if low < b[0] else b[0]  # no number if the polynomial is none
    return low


@inlined
def positive(c, t):
    """Whether the polynomial c (8,) is certainly positive on [0, t].

    Mostly that can be told with the terms from the fourth power on taken by their size, for half of what `least` costs.
    """
    t2 = t * t
    line, square = c[1] * t * (1 / 3), c[2] * t2 * (1 / 3)
    first, second, last = c[0] + line, c[0] + 2.0 * line + square, c[0] + 3.0 * (line + square) + c[3] * (t * t2)
    rest = (t2 * t2) * ((abs(c[4]) + t * abs(c[5])) + t2 * (abs(c[6]) + t * abs(c[7])))
    return min(min(c[0], first), min(second, last)) > rest or least(c, t) > 0.0


@inlined
def safe_time(c, horizon):
    """A time in [0, horizon] up to which the polynomial c (8,) is positive: close to its first zero if that is simple,
    and at least half as far as its Bernstein coefficients tell, or 0 if not c[0] > 0.

    They tell it at least as far as no zero, real or complex, lies in the disc with diameter [0, t].
    """
    if not c[0] > 0.0:
        return 0.0
    if least(c, horizon) > 0.0:
        return horizon
    t = c[0] / max(-c[1], c[0] / horizon)
    for _ in range(3):
        rate = slope(c, t)
        t = min(max(t - value(c, t) / rate, 0.1 * t), horizon) if rate < 0.0 else 0.5 * t
    t *= 1.0 - 1e-9
    while not least(c, t) > 0.0:
        if not t > MOMENT:
            return 0.0
        t *= 0.7
    while 2.0 * t < horizon and least(c, 2.0 * t) > 0.0:
        t *= 2.0
    return t


UNCERTAIN = (False, 0.0, math.inf)
MOST_STEPS = 8
CONVERGING = 1e-8  # a step of Newton's method so short leaves an error below rounding


@inlined
def crossing(c, remainder, margin, horizon, short):
    """(certain, time, width): where a constraint that falls all the while meets zero, certainly, at time +- width.

    c: its Taylor polynomial (8,), c1 < 0; remainder: bound on its seventh derivative over 5040; margin: rounding of c0.
    Width inf says that it holds up to time = horizon. A time no longer than short is exact to rounding.
    """
    low = (c[0], c[1], c[2], c[3], c[4], c[5], c[6], -remainder)
    fall = (-c[1], -2.0 * c[2], -3.0 * c[3], -4.0 * c[4], -5.0 * c[5], -6.0 * c[6], -7.0 * remainder, 0.0)
    if value(low, horizon) > margin and positive(fall, horizon):
        return True, horizon, math.inf
    root = c[1] * c[1] - 4.0 * c[0] * c[2]
    t = 2.0 * c[0] / (math.sqrt(root) - c[1]) if root > 0.0 else -c[0] / c[1]
    f, g = value(low, t), slope(low, t)
    t -= f * g / (g * g - f * half_curvature(low, t))  # Halley's method
    size, square = abs(t), t * t
    unsure = abs(value(low, t)) + margin + 2.0 * remainder * (size * square * (square * square))
    until = 1.125 * size - 8.0 * margin / c[1]
    if not size <= until <= horizon:
        return UNCERTAIN
    width = unsure / least(fall, until)
    if not (width > 0.0 and t + width <= until):
        return UNCERTAIN
    if size <= short:
        zero = nearby_zero(c, t)
        return (True, zero, width) if abs(zero - t) <= width else UNCERTAIN
    return (True, t, width) if width <= 0.5 * t else UNCERTAIN


@inlined
def nearby_zero(c, t):
    """The zero of the polynomial c (8,) that Newton's method reaches from t, or nan."""
    inverse = 1.0 / c[1]
    near, b, d, e = -c[0] * inverse, c[2] * inverse, c[3] * inverse, c[4] * inverse
    if abs(near * b) < 0.05:  # four terms of the series of the inverse function
        t = near + near * near * (near * ((2.0 * b * b - d) + near * (5.0 * b * (d - b * b) - e)) - b)
    for _ in range(MOST_STEPS):
        step = value(c, t) / slope(c, t)
        t -= step
        if abs(step) <= CONVERGING:
            return t
    return math.nan


@inlined
def return_time(c, remainder, horizon):
    """The end of a very short hop, c0 = 0 and c1 > 0, to rounding, if it certainly ends so; else inf.

    c, remainder: as for `crossing`. The zero at the start is divided out, so that the time keeps its relative accuracy
    however short the hop.
    """
    t = -c[1] / c[2] if c[2] < 0.0 else math.inf
    if t > 0.5 * horizon or 8.0 * t * spread(c, remainder, t) > -c[2]:
        return math.inf
    return nearby_zero((c[1], c[2], c[3], c[4], c[5], c[6], c[7], 0.0), t)


@inlined
def spread(c, remainder, t):
    """Bound on the change over [0, t] of half the second derivative of a constraint, per unit of time."""
    high = 15.0 * abs(c[6]) + t * 21.0 * remainder
    return 3.0 * abs(c[3]) + t * (6.0 * abs(c[4]) + t * (10.0 * abs(c[5]) + t * high))
