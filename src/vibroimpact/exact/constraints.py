"""The unilateral constraints of each module along a flight: gaps to the walls, contact force of a sticking ball."""

import math

import numpy as np

from vibroimpact.exact.compiled import compiled
from vibroimpact.exact.exclusion import crossing_time, nearby_zero, return_time, safe_time
from vibroimpact.exact.flow import acceleration, inverse_masses

RESOLUTION = 4.0 * np.finfo(float).eps
SHORT = 1e-3  # in units of the flow: a fifth-order Taylor step this long is exact to rounding


@compiled
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


@compiled
def _energy_bound(q, mode, y1, y2, z1, z2):
    """Bound on all later velocities of unforced boxes, displaced by y with velocities z: dampings only take away."""
    m1, m2 = (q.mass if mode & 1 else 1.0), (q.mass if mode & 2 else 1.0)
    energy = m1 * z1 * z1 + m2 * z2 * z2 + q.k11 * y1 * y1 + 2.0 * q.k12 * y1 * y2 + q.k22 * y2 * y2
    return math.sqrt(energy) * (1.0 + 1e-12)


@compiled
def fifth_bound(q, mode, d, horizon):
    """Bound on |X_i^(5)| of both boxes over the next horizon.

    The fourth derivative of the boxes obeys the boxes' equations under that of the force, so the square root of twice
    its energy, which bounds its velocity, grows no faster than that force.
    """
    return _energy_bound(q, mode, d[4], d[5], d[6], d[7]) + horizon * q.drive * q.omega**4


@compiled
def _sixth_bound(q, mode, d, sine, horizon):
    """Bound on |X_i^(6)| of both boxes over the next horizon, as fifth_bound."""
    i1, i2 = inverse_masses(q, mode)
    force = q.omega**4 * sine
    e1, e2 = acceleration(q, i1, i2, d[4], d[5], d[6], d[7], q.f1 * force, q.f2 * force)
    return _energy_bound(q, mode, d[6], d[7], e1, e2) + horizon * q.drive * q.omega**5


@compiled
def acceleration_rounding(q, boxes):
    """Size below which a box acceleration is rounding."""
    positions, velocities = abs(boxes[0]) + abs(boxes[1]), abs(boxes[2]) + abs(boxes[3])
    return RESOLUTION * (q.drive + (q.k11 + q.k22) * positions + (q.c11 + q.c22) * velocities)


@compiled
def gap_rounding(boxes, balls, i):
    """Size below which a gap of module i is rounding."""
    speeds = abs(boxes[2 + i]) + abs(balls[2 + i])  # over a unit of time they enter like positions
    return RESOLUTION * (1.0 + abs(boxes[i]) + abs(balls[i]) + speeds)


@compiled
def _time_of(g, v, higher, bound, margin, horizon):
    """(time the constraint certainly holds or time of its crossing, whether it is a crossing, g within rounding).

    Within rounding of zero the constraint is met at once, unless it certainly rises by more than rounding first.
    """
    a, j, s = higher
    if v > 0.0:
        t = crossing_time(g, v, higher, bound, horizon)
        if t < math.inf:
            return t, True, False
    if g <= 2.0 * margin:
        if v > 0.0:
            return 0.0, True, True
        if v < 0.0 and (a < 0.0 or v * v > 2.0 * a * margin):
            return safe_time((-v, -a / 2, -j / 6, -s / 24, -bound / 120, 0.0), horizon), False, False
        return safe_time((margin, -v, -a / 2, -j / 6, -s / 24, -bound / 120), horizon), False, False
    return safe_time((g - margin, -v, -a / 2, -j / 6, -s / 24, -bound / 120), horizon), False, False


@compiled
def _hop_time(v, higher, bound, at_rest, margin, horizon, short):
    """(time, crossing) for the wall that the ball touches: v <= 0 is its velocity towards it, at_rest says v is 0.

    A hop no longer than short is timed to its end; else the zero at the start is divided out of the constraint.
    """
    a, j, s = higher
    if at_rest:
        if a < 0.0:
            return safe_time((-a / 2, -j / 6, -s / 24, -bound / 120, 0.0, 0.0), horizon), False
        return safe_time((margin, 0.0, 0.0, -j / 6, -s / 24, -bound / 120), horizon), False
    t = return_time(-v, higher, bound, horizon)
    if t <= short:
        return t, True
    return safe_time((-v, -a / 2, -j / 6, -s / 24, -bound / 120, 0.0), horizon), False


@compiled
def wall_time(i, boxes, balls, d):
    """Time at which the ball of module i, close to a wall, meets it; of either sign."""
    relative, velocity = boxes[i] - balls[i], boxes[2 + i] - balls[2 + i]
    w = 1.0 if relative > 0.0 else -1.0
    return nearby_zero(1.0 - w * relative, w * velocity, (w * d[i], w * d[2 + i], w * d[4 + i]))


@compiled
def module_time(q, mode, i, boxes, balls, wall, touching, d, bound, sine, horizon, short):
    """How far module i may fly: (time, crossing, undecided).

    Without a crossing the module has no event up to time. With one, its next event is at time, to fifth order (slightly
    negative when just passed); undecided marks a tangential meeting that rounding cannot tell from a miss.
    bound: fifth_bound over the horizon; wall: the wall the ball sticks to, or 0; touching: the wall it touches now,
    moving inwards or at rest. A hop on it no longer than short is timed to its end.
    """
    if wall != 0:  # the contact force, per unit of ball mass, is wall X'' and must push
        higher = (-wall * d[4 + i], -wall * d[6 + i], _sixth_bound(q, mode, d, sine, horizon))
        return _time_of(wall * d[i], -wall * d[2 + i], higher, 0.0, acceleration_rounding(q, boxes), horizon)
    margin = gap_rounding(boxes, balls, i)
    relative = boxes[i] - balls[i]
    velocity = boxes[2 + i] - balls[2 + i]
    time, crossing, undecided = horizon, False, False
    for w in (1, -1):
        higher = (w * d[i], w * d[2 + i], w * d[4 + i])
        if w != touching:
            t, c, u = _time_of(1.0 - w * relative, w * velocity, higher, bound, margin, time)
        else:
            if velocity == 0.0 and abs(d[i]) <= acceleration_rounding(q, boxes):
                higher = (0.0, higher[1], higher[2])
            t, c = _hop_time(w * velocity, higher, bound, velocity == 0.0, margin, time, short)
            u = False
        if t < time:
            time, crossing, undecided = t, c, u
    return time, crossing, undecided
