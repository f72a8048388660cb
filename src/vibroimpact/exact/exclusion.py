"""How long a constraint certainly holds: conservative advancement with a bound of fifth order.

A constraint is a smooth g(t) >= 0 (the gap to a wall, or the contact force of a sticking ball). With its first
derivatives and a bound on the modulus of the next it stays above a polynomial c0 + c1 t + ... + c5 t^5, and that is
positive on [0, T] if its coefficients in the Bernstein basis of [0, T] are. Repeated from the safe side, the times T
converge to the first zero of g and never pass it. A power of t that makes g vanish at the start is divided out before.
"""

import math

from vibroimpact.exact.compiled import compiled


@compiled
def _positive(c, t):
    """Whether a quintic c (6,) is positive on [0, t], by its Bernstein coefficients there (sufficient)."""
    d1, d2, d3 = c[1] * t, c[2] * t * t, c[3] * t * t * t
    d4, d5 = c[4] * t**4, c[5] * t**5
    b1 = c[0] + 0.2 * d1
    b2 = c[0] + 0.4 * d1 + 0.1 * d2
    b3 = c[0] + 0.6 * d1 + 0.3 * d2 + 0.1 * d3
    b4 = c[0] + 0.8 * d1 + 0.6 * d2 + 0.4 * d3 + 0.2 * d4
    b5 = c[0] + d1 + d2 + d3 + d4 + d5
    return min(min(min(c[0], b1), min(b2, b3)), min(b4, b5)) > 0.0


@compiled
def safe_time(c, horizon):
    """A time in [0, horizon] up to which the quintic c (6,) is positive, close to its first zero where that is simple.

    0 if c[0] is not positive.
    """
    if c[0] <= 0.0:
        return 0.0
    if _positive(c, horizon):
        return horizon
    t = c[0] / max(-c[1], c[0] / horizon)
    for _ in range(3):
        value = c[0] + t * (c[1] + t * (c[2] + t * (c[3] + t * (c[4] + t * c[5]))))
        slope = c[1] + t * (2.0 * c[2] + t * (3.0 * c[3] + t * (4.0 * c[4] + t * 5.0 * c[5])))
        t = min(max(t - value / slope, 0.1 * t), horizon) if slope < 0.0 else 0.5 * t
    t *= 1.0 - 1e-9
    while not _positive(c, t):
        t *= 0.7
    return t


@compiled
def crossing_time(g, v, higher, bound, horizon):
    """The time of the only zero nearby, to sixth order, if the constraint certainly falls through it; else inf.

    g, v: the constraint and minus its rate; higher: -g'' to -g^(4); bound: on |g^(5)|. With h = 2 |g| / v and a change
    of slope below v / 2 on [-h, h] there is one zero.
    """
    a, j, s = higher
    h = 2.0 * abs(g) / v
    if h > horizon or h * (abs(a) + h * (abs(j) / 2 + h * (abs(s) / 6 + h * bound / 24))) >= 0.5 * v:
        return math.inf
    return nearby_zero(g, v, higher)


@compiled
def nearby_zero(g, v, higher):
    """The zero of g - v t - a t^2 / 2 - j t^3 / 6 - s t^4 / 24 that Newton's method reaches from t = g / v."""
    a, j, s = higher
    t = g / v
    for _ in range(3):
        fall = t * (v + t * (a / 2 + t * (j / 6 + t * s / 24)))
        slope = v + t * (a + t * (j / 2 + t * s / 6))
        t -= (fall - g) / slope
    return t


@compiled
def return_time(u, higher, bound, horizon):
    """The end of a very short hop, g(0) = 0 and g'(0) = u > 0, to fifth order, if it certainly ends so; else inf.

    The zero at the start is divided out, so that the time keeps its relative accuracy however short the hop.
    """
    a, j, s = higher
    t = 2.0 * u / a if a > 0.0 else math.inf
    if t > 0.5 * horizon or t * (abs(j) + t * (abs(s) / 2 + t * bound / 6)) > 0.125 * a:
        return math.inf
    for _ in range(4):
        t = u / (a / 2 + t * (j / 6 + t * s / 24))
    return t
