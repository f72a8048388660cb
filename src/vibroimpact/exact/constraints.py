"""The unilateral constraints of each module along a flight: gaps to the walls, contact force of a sticking ball."""

import math

import numpy as np
from numba import njit

from vibroimpact.exact.exclusion import crossing_time, leaving_time, return_time, safe_time
from vibroimpact.exact.flow import acceleration, inverse_masses

RESOLUTION = 4.0 * np.finfo(float).eps
SHORT = 0.03  # in steps of the flow table: a fifth-order Taylor step this long is exact to rounding


@njit(cache=True)
def derivatives(q, mode, boxes, sine, cosine):
    """Derivatives 2 to 5 of X1 and X2 in free flight: (X1'', X2'', X1''', X2''', ..., X2^(5))."""
    i1, i2 = inverse_masses(q, mode)
    w = q.omega
    s, c = sine, cosine * w
    a1, a2 = acceleration(q, i1, i2, boxes[0], boxes[1], boxes[2], boxes[3], q.f1 * s, q.f2 * s)
    b1, b2 = acceleration(q, i1, i2, boxes[2], boxes[3], a1, a2, q.f1 * c, q.f2 * c)
    s, c = -w * w * s, -w * w * c
    c1, c2 = acceleration(q, i1, i2, a1, a2, b1, b2, q.f1 * s, q.f2 * s)
    d1, d2 = acceleration(q, i1, i2, b1, b2, c1, c2, q.f1 * c, q.f2 * c)
    return a1, a2, b1, b2, c1, c2, d1, d2


@njit(cache=True)
def derivative_bound(q, mode, d, order, horizon):
    """A bound on the modulus of X_i^(order), order 3 to 5, over the next horizon, for both boxes.

    A derivative of the boxes obeys the boxes' equations under the same derivative of the force, so the square root of
    twice its energy, which bounds its velocity, grows no faster than that force: the dampings only take away.
    """
    i1, i2 = inverse_masses(q, mode)
    k = 2 * (order - 3)
    y1, y2, z1, z2 = d[k], d[k + 1], d[k + 2], d[k + 3]
    energy = z1 * z1 / i1 + z2 * z2 / i2 + q.k11 * y1 * y1 + 2.0 * q.k12 * y1 * y2 + q.k22 * y2 * y2
    force = math.sqrt(q.f1 * q.f1 + q.f2 * q.f2)
    return (math.sqrt(energy) + horizon * force * q.omega ** (order - 1)) * (1.0 + 1e-12)


@njit(cache=True)
def acceleration_rounding(q, boxes):
    """Size below which a box acceleration is rounding."""
    force = abs(q.f1) + abs(q.f2)
    return RESOLUTION * (
        force + (q.k11 + q.k22) * (abs(boxes[0]) + abs(boxes[1])) + (q.c11 + q.c22) * (abs(boxes[2]) + abs(boxes[3]))
    )


@njit(cache=True)
def gap_rounding(boxes, balls, i):
    """Size below which a gap of module i is rounding."""
    return RESOLUTION * (1.0 + abs(boxes[i]) + abs(balls[i]))


@njit(cache=True)
def _time_of(g, v, higher, bound, margin, horizon):
    """(time the constraint certainly holds or time of its crossing, whether it is a crossing, g within rounding)."""
    if v > 0.0:
        t = crossing_time(g, v, higher, bound, horizon)
        if t < math.inf:
            return t, True, False
        if g <= margin:
            return 0.0, True, True
    return safe_time(max(g - margin, 0.0), v, higher[0], bound, horizon), False, False


@njit(cache=True)
def module_time(q, mode, i, boxes, balls, wall, touching, d, horizon, short):
    """How far module i may fly: (time, crossing, undecided).

    Without a crossing the module has no event up to time. With one, its next event is at time, to fourth order
    (slightly negative when just passed); undecided marks a tangential meeting that rounding cannot tell from a miss.
    wall: the wall that the ball sticks to, or 0; touching: the wall that it touches now, moving inwards or at rest.
    A hop on the wall touched is timed to the end if it is no longer than short.
    """
    a, j, s, r = d[i], d[2 + i], d[4 + i], d[6 + i]
    if wall != 0:
        bound = derivative_bound(q, mode, d, 5, horizon)
        margin = acceleration_rounding(q, boxes)
        return _time_of(wall * a, -wall * j, (-wall * s, -wall * r, 0.0, 0.0), bound, margin, horizon)
    bound = derivative_bound(q, mode, d, 3, horizon)
    margin = gap_rounding(boxes, balls, i)
    relative = boxes[i] - balls[i]
    velocity = boxes[2 + i] - balls[2 + i]
    time, crossing, undecided = horizon, False, False
    for w in (1, -1):
        if w != touching:
            t, c, u = _time_of(1.0 - w * relative, w * velocity, (w * a, w * j, w * s, w * r), bound, margin, time)
        elif velocity == 0.0:
            outwards = w * a if w * a < -acceleration_rounding(q, boxes) else 0.0
            t = leaving_time(outwards, w * j, derivative_bound(q, mode, d, 4, horizon), horizon)
            c, u = False, False
        else:
            t, c, u = return_time(-w * velocity, (w * a, w * j, w * s, w * r), bound, horizon), True, False
            if t > short:
                t, c = safe_time(0.0, w * velocity, w * a, bound, horizon), False
        if t < time:
            time, crossing, undecided = t, c, u
    return time, crossing, undecided
