"""How long a constraint certainly holds: conservative advancement with a third-order bound.

A constraint is a smooth g(t) >= 0 (the gap to a wall, or the contact force of a sticking ball). From g, its first two
derivatives and a bound on the modulus of the third, every t up to the returned time has g(t) >= 0, proved by

    g(t) >= g - v t - a t^2 / 2 - bound t^3 / 6,   v = -g', a = -g'',   and t^3 <= h t^2 on [0, h].

Repeated from the safe side, the times converge cubically to a transversal zero of g and never pass it.
"""

import math

from numba import njit


@njit(cache=True, inline="always")
def _first_zero(g, v, a):
    """First t > 0 where g - v t - a t^2 / 2 falls to 0 (inf if never), for g >= 0; where g = 0, v <= 0 is needed."""
    root = v * v + 2.0 * a * g
    if root < 0.0:
        return math.inf
    root = math.sqrt(root)
    if v > 0.0:
        return 2.0 * g / (v + root)
    return (root - v) / a if a > 0.0 else math.inf


@njit(cache=True)
def safe_time(g, v, a, bound, horizon):
    """A time in [0, horizon] up to which the constraint certainly holds, close to the best the bound allows."""
    early = _first_zero(g, v, a + bound * horizon / 3.0)
    if early >= horizon:
        return horizon
    late = min(horizon, _first_zero(g, v, a + bound * early / 3.0))
    middle = math.sqrt(early * late)  # the best time, where it equals its own horizon, lies between the two
    return max(early, min(middle, _first_zero(g, v, a + bound * middle / 3.0)))


@njit(cache=True)
def leaving_time(a, j, bound, horizon):
    """As safe_time for a constraint that starts at g = g' = 0, with a = -g'' <= 0, j = -g''' and |g''''| <= bound.

    g(t) >= t^2 (-a / 2 - j t / 6 - bound t^2 / 24), and the bracket starts positive, or at 0 with positive slope.
    """
    return min(horizon, _first_zero(-0.5 * a, j / 6.0, bound / 12.0))


@njit(cache=True)
def crossing_time(g, v, higher, bound, horizon):
    """The time of the only zero nearby, to sixth order, if the constraint certainly falls through it; else inf.

    higher: -g'' to -g^(5). With h = 2 |g| / v and |g''| h + bound h^2 / 2 < v / 2 the slope stays beyond v / 2 on
    [-h, h]: there is one zero.
    """
    a, j, s, r = higher
    h = 2.0 * abs(g) / v
    if h > horizon or abs(a) * h + 0.5 * bound * h * h >= 0.5 * v:
        return math.inf
    t = g / v
    for _ in range(3):
        fall = t * (v + t * (a / 2 + t * (j / 6 + t * (s / 24 + t * r / 120))))
        slope = v + t * (a + t * (j / 2 + t * (s / 6 + t * r / 24)))
        t -= (fall - g) / slope
    return t


@njit(cache=True)
def return_time(u, higher, bound, horizon):
    """The end of a very short hop, g(0) = 0 and g'(0) = u > 0, to sixth order, if it certainly ends so; else inf.

    The zero at the start is divided out, so that the time keeps its relative accuracy however short the hop.
    """
    a, j, s, r = higher
    t = 2.0 * u / a if a > 0.0 else math.inf
    if t > 0.5 * horizon or 2.0 * bound * t > 0.25 * a:
        return math.inf
    for _ in range(4):
        slope = a / 2 + t * (j / 6 + t * (s / 24 + t * r / 120))
        t = u / slope
    return t
