"""Prove that the constraints of a flight are satisfied over some time, and bracket the time of the first violation.

A constraint is a smooth function g(t) >= 0: the gap to a wall, or the contact force of a sticking ball. The Taylor
polynomial of degree 6 of g and a bound on the seventh derivative of g give a lower bound c0 + ... + c7 t^7. This bound
is positive on [0, T] if its coefficients in the Bernstein basis of [0, T] are positive. Steps of such lengths T
approach the first zero of g and never pass the zero. If the rate of g keeps its sign, g has at most one zero, which can
be approached from either side.

The proofs use floating-point arithmetic. Callers lower c0 by a margin for the rounding errors of g. In this file,
"certain" means proved with this margin.
"""

import math

import numpy as np

from vibroimpact.exact.engine.compiled import inlined, inlined_source
from vibroimpact.exact.engine.flow import half_curvature, jet, mode_of, slope, value

SHORTEST_TIME = 1e-300  # `safe_time` returns 0 if no proof succeeds for a longer time


@inlined
def least(c, t):
    """Return a lower bound on [0, t] for the polynomial with the eight coefficients c.

    The bound is the smallest coefficient of the polynomial in the Bernstein basis of [0, t].
    """
    t2 = t * t
    t3, t4 = t2 * t, t2 * t2
    first = c[0], c[1] * t * (1 / 7), c[2] * t2 * (1 / 21), c[3] * t3 * (1 / 35)
    second = c[4] * t4 * (1 / 35), c[5] * (t2 * t3) * (1 / 21), c[6] * (t3 * t3) * (1 / 7), c[7] * (t3 * t4)
    b = first + second
    low = c[0]
    for _ in range(7):  # Bernstein coefficient k is the sum over j of binomial(k, j) b[j], with the initial b
        b = (b[0] + b[1], b[1] + b[2], b[2] + b[3], b[3] + b[4], b[4] + b[5], b[5] + b[6], b[6] + b[7], b[7])
        low = low if low < b[0] else b[0]  # this gives nan if a coefficient is nan
    return low


@inlined
def positive(c, t):
    """Return True if the polynomial with the eight coefficients c is certainly positive on [0, t].

    A cheap lower bound is tried first, then the bound from `least`.
    """
    t2 = t * t
    line, square = c[1] * t * (1 / 3), c[2] * t2 * (1 / 3)
    first, second, last = c[0] + line, c[0] + 2.0 * line + square, c[0] + 3.0 * (line + square) + c[3] * (t * t2)
    rest = (t2 * t2) * ((abs(c[4]) + t * abs(c[5])) + t2 * (abs(c[6]) + t * abs(c[7])))
    return min(min(c[0], first), min(second, last)) > rest or least(c, t) > 0.0


@inlined
def safe_time(c, horizon):
    """Return a time in [0, horizon] up to which the polynomial with the eight coefficients c is certainly positive.

    If c[0] is not positive, the time is 0. If the first zero is simple, the time is close to this zero. In every case,
    the time is at least half of the longest time t for which the Bernstein coefficients on [0, t] are positive. These
    coefficients are positive if the disc with diameter [0, t] contains no real or complex zero.
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
        if not t > SHORTEST_TIME:
            return 0.0
        t *= 0.7
    while 2.0 * t < horizon and least(c, 2.0 * t) > 0.0:
        t *= 2.0
    return t


UNCERTAIN = (False, 0.0, math.inf)
MOST_STEPS = 8
CONVERGING = 1e-8  # after a Newton step shorter than this, the error is below rounding


@inlined
def crossing(c, remainder, margin, horizon, short):
    """Return (certain, time, width) for the first zero of a decreasing constraint.

    If `certain` is True and `width` is finite, the constraint certainly has its first zero at `time` +- `width`. If
    also |time| <= short, `time` is exact to rounding. If `certain` is True and `width` is inf, the constraint certainly
    has no zero before the horizon. If `certain` is False, nothing is proved.

    c: the eight Taylor coefficients of the constraint, with c[1] < 0.
    remainder: bound on |seventh derivative| / 5040.
    margin: bound on the rounding error of c[0].
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
    """Return the zero near t of the polynomial with the eight coefficients c, by Newton's method.

    If Newton's method does not converge, return nan.
    """
    inverse = 1.0 / c[1]
    near, b, d, e = -c[0] * inverse, c[2] * inverse, c[3] * inverse, c[4] * inverse
    if abs(near * b) < 0.05:  # the first value is the sum of four terms of the inverse series
        t = near + near * near * (near * ((2.0 * b * b - d) + near * (5.0 * b * (d - b * b) - e)) - b)
    for _ in range(MOST_STEPS):
        step = value(c, t) / slope(c, t)
        t -= step
        if abs(step) <= CONVERGING:
            return t
    return math.nan


@inlined
def return_time(c, remainder, horizon):
    """Return the end time of a very short hop, in which a ball leaves a wall and returns to this wall.

    The time is exact to rounding. If the time is uncertain, return inf.

    c, remainder: as for `crossing`, for the gap to the wall, with c[0] = 0 and c[1] > 0.
    """
    t = -c[1] / c[2] if c[2] < 0.0 else math.inf
    if t > 0.5 * horizon or 8.0 * t * spread(c, remainder, t) > -c[2]:
        return math.inf
    # Division of the polynomial by t removes the zero at t = 0. The other zero then keeps its relative accuracy.
    return nearby_zero((c[1], c[2], c[3], c[4], c[5], c[6], c[7], 0.0), t)


@inlined
def spread(c, remainder, t):
    """Return a bound on |h(t) - h(0)| / t, where h is half the second derivative of a constraint.

    c, remainder: Taylor coefficients and remainder bound of the constraint, as for `crossing`.
    """
    high = 15.0 * abs(c[6]) + t * 21.0 * remainder
    return 3.0 * abs(c[3]) + t * (6.0 * abs(c[4]) + t * (10.0 * abs(c[5]) + t * high))


RESOLUTION = 4.0 * np.finfo(float).eps
ZERO_FACTOR = 2.0  # a constraint below 2 rounding errors counts as 0, since proofs near 0 would need tiny steps
DOUBT_FACTOR = 2.0 * ZERO_FACTOR
"""Distance, in units of `gap_rounding`, below which rounding decides whether a ball hits or misses a wall. With other
steps, as in an ensemble, the decision may differ."""
LOOKAHEAD = 2.5
ZERO_FORCE_MARGIN = 1e-300  # keeps the margin of a contact force positive if the force stays zero
SHORT = 0.02  # time (in units of `Flow.unit`) up to which Taylor polynomials of the boxes are exact to rounding


@inlined
def remainder(q, mode, jets, growth):
    """Return a bound on |X_i^(7)| / 7! that holds for both boxes.

    The sixth derivatives of the displacements obey the equations of motion, with the sixth derivative of the external
    force as forcing. The velocities of this auxiliary motion are the seventh derivatives of the displacements.
    These derivatives are at most sqrt(2 E), where E is the energy of the auxiliary motion. Damping can only reduce E.
    Therefore sqrt(2 E) grows by at most `growth`.

    growth: bound on the time integral of the sixth derivative of the external force.
    """
    one, two = jets
    m1, m2 = (q.mass if mode & 1 else 1.0), (q.mass if mode & 2 else 1.0)
    y1, y2, z1, z2 = one[6] * (1 / 7), two[6] * (1 / 7), one[7], two[7]
    energy = m1 * z1 * z1 + m2 * z2 * z2 + y1 * y1 + q.ground * y2 * y2 - q.k12 * ((y1 - y2) * (y1 - y2))
    return (math.sqrt(energy) + growth * (1 / 5040)) * (1.0 + 1e-12)


@inlined
def own_remainder(q, mode, jets, both, i, force, horizon):
    """Return a bound on |X_i^(7)| / 7! for box i alone; `remainder` bounds both boxes together.

    The energy of a box grows by the work of the force on the box and of the coupling. With weak coupling, the bound
    therefore hardly depends on the other box.

    both: bound for both boxes, from `remainder`. force: bound on the sixth derivative of the force on box i.
    """
    m, k, p = (q.mass if mode & (i + 1) else 1.0), (q.k11 if i == 0 else q.k22), (jets[0] if i == 0 else jets[1])
    passed = (abs(q.k12) / math.sqrt(q.ground if i == 0 else 1.0) + abs(q.c12)) * both
    own = math.sqrt(m * p[7] * p[7] + k * (p[6] * (1 / 7)) ** 2) + horizon * (force * (1 / 5040) + passed)
    return min(both, own * (1.0 + 1e-12))


@inlined
def acceleration_rounding(q, boxes, i):
    """Return the size of the rounding error in the acceleration of box i."""
    x1, x2, v1, v2 = abs(boxes[0]), abs(boxes[1]), abs(boxes[2]), abs(boxes[3])
    coupling = abs(q.k12) * (x2 if i == 0 else x1) + abs(q.c12) * (v2 if i == 0 else v1)
    if i == 0:
        return RESOLUTION * (abs(q.f1) + q.k11 * x1 + q.c11 * v1 + coupling)
    return RESOLUTION * (abs(q.f2) + q.k22 * x2 + q.c22 * v2 + coupling)


@inlined
def gap_rounding(q, boxes, balls, i):
    """Return the size of the rounding error in a gap of module i after a flight."""
    x1, x2, v1, v2 = boxes  # a velocity counts as the distance moved in a unit of time
    return RESOLUTION * (1.0 + abs(x1) + abs(x2) + abs(v1) + abs(v2) + abs(balls[i]) + abs(balls[2 + i]) + q.shift)


@inlined
def gap(p, position, velocity, w):
    """Return the eight Taylor coefficients of the gap between a free ball and wall w.

    p: Taylor coefficients of the box displacement. position, velocity: position and velocity of the ball.
    """
    near, approach = 1.0 - w * (p[0] - position), -w * (p[1] - velocity)
    return near, approach, -w * p[2], -w * p[3], -w * p[4], -w * p[5], -w * p[6], -w * p[7]


@inlined
def push(q, mode, jets, i, wall, sine, cosine, horizon):
    """Return (Taylor coefficients, remainder bound) of the force of the wall on the sticking ball i, per ball mass.

    Up to its sign, this force is the acceleration of the box. The accelerations of the boxes obey the equations of
    motion, with the second derivative of the external force as forcing.
    """
    one, two = jets
    fall = -wall * q.omega * q.omega
    start = (wall * 2.0 * one[2], wall * 2.0 * two[2], wall * 6.0 * one[3], wall * 6.0 * two[3])
    bent = jet(q, mode, start, fall * sine, fall * cosine)
    both = remainder(q, mode, bent, horizon * q.growth * q.omega**2)
    bound = own_remainder(q, mode, bent, both, i, abs(q.f1 if i == 0 else q.f2) * q.omega**8, horizon)
    return (bent[0] if i == 0 else bent[1]), bound


@inlined
def _safe_time(c, bound, margin, horizon):
    """Return (time, due): the constraint certainly holds up to `time`, and `due` is True if an event is due now.

    An event is due now if the constraint is zero within rounding and decreases.

    c: Taylor coefficients of the constraint. bound: bound on the remainder. margin: rounding error of c[0].
    """
    if c[0] > ZERO_FACTOR * margin:
        return safe_time((c[0] - margin, c[1], c[2], c[3], c[4], c[5], c[6], -bound), horizon), False
    if c[1] < 0.0:
        return 0.0, True
    rises = c[1] > 0.0 and (c[2] > 0.0 or c[1] * c[1] > -4.0 * c[2] * margin)
    return _time_from_zero(c, bound, margin, horizon, rises), False


@inlined
def _time_from_zero(c, bound, margin, horizon, rises):
    """Return a time up to which a constraint that is initially zero within rounding is certainly satisfied.

    If the constraint rises, its polynomial is divided by t, which removes the initial zero. If the constraint does not
    rise, the function only proves that the constraint stays above -margin. The function also does so if the remainder
    bound reduces the proved time to less than half.
    """
    time = 0.0
    if rises:
        time = safe_time((c[1], c[2], c[3], c[4], c[5], c[6], -bound, 0.0), horizon)
        if time == horizon or safe_time((c[1], c[2], c[3], c[4], c[5], c[6], 0.0, 0.0), horizon) <= 2.0 * time:
            return time
    return max(time, safe_time((margin, c[1], c[2], c[3], c[4], c[5], c[6], -bound), horizon))


@inlined_source
def _hop_time(c, bound, margin, horizon, short):
    """Return (time, back) for a hop of a ball: the ball leaves the wall that it touches, and returns to this wall.

    If `back` is True, the hop ends at `time`. If `back` is False, the hop certainly does not end before `time`.
    """
    if c[1] == 0.0:
        rise = safe_time((c[2], c[3], c[4], c[5], c[6], -bound, 0.0, 0.0), horizon)
        return max(rise, _time_from_zero(c, bound, margin, horizon, False)), False
    t = return_time(c, bound, horizon)
    if t <= short:
        return t, True
    return _time_from_zero(c, bound, margin, horizon, True), False


@inlined
def module_time(q, motion, i, jets, bound, horizon, short):
    """Return (time, width, undecided) for the next event in module i.

    If `width` is finite, the event happens at `time` +- `width`. `undecided` is True if rounding decides whether this
    event happens. If `width` is inf, certainly no event happens before `time`. Just after an event, `time` may be
    slightly negative.

    jets: Taylor polynomials of both boxes. short: time up to which these polynomials are exact to rounding.
    bound: bound on the remainders of these polynomials, from `remainder`.
    """
    if motion.walls[i] != 0:
        return _sticking_time(q, motion, i, jets, horizon, short)
    velocity = motion.boxes[2 + i] - motion.balls[2 + i]
    if velocity != 0.0:  # while the velocity keeps its sign, only the wall ahead matters
        ahead = 1.0 if velocity > 0.0 else -1.0
        c = gap(jets[0] if i == 0 else jets[1], motion.balls[i], motion.balls[2 + i], ahead)
        certain, t, width = crossing(c, bound, gap_rounding(q, motion.boxes, motion.balls, i), horizon, short)
        if certain:
            return t, width, False
    return _turning_time(q, motion, i, jets, bound, horizon, short)


@inlined_source
def _sticking_time(q, motion, i, jets, horizon, short):
    """Return the result of `module_time` for a module whose ball sticks.

    The constraint is that the contact force pushes the ball.
    """
    c, bound = push(q, mode_of(motion.walls), jets, i, motion.walls[i], motion.sine, motion.cosine, horizon)
    # The second term bounds the rounding error of the change of the force. Without this term, the margin could be
    # almost zero.
    margin = acceleration_rounding(q, motion.boxes, i) + RESOLUTION * bound * horizon**7 + ZERO_FORCE_MARGIN
    if c[1] < 0.0:
        certain, t, width = crossing(c, bound, margin, horizon, short)
        if certain:
            return t, width, False
    t, met = _safe_time(c, bound, margin, horizon)
    return t, (0.0 if met else math.inf), met


@inlined_source
def _turning_time(q, motion, i, jets, bound, horizon, short):
    """Return the result of `module_time` for a flying ball whose velocity relative to the box may change sign."""
    boxes, balls = motion.boxes, motion.balls
    margin = gap_rounding(q, boxes, balls, i)
    force = abs(q.f1 if i == 0 else q.f2) * q.omega**6
    bound = own_remainder(q, mode_of(motion.walls), jets, bound, i, force, horizon)
    time, width, undecided = horizon, math.inf, False
    for w in (1, -1):
        c = gap(jets[0] if i == 0 else jets[1], balls[i], balls[2 + i], w)
        if w != motion.touching[i]:
            t, met = _safe_time(c, bound, margin, time)
            doubt = met
        else:
            if c[1] == 0.0 and abs(2.0 * c[2]) <= acceleration_rounding(q, boxes, i):
                c = (c[0], c[1], 0.0, c[3], c[4], c[5], c[6], c[7])
            t, met = _hop_time(c, bound, margin, time, short)
            doubt = False
        if t < time:
            time, width, undecided = t, (0.0 if met else math.inf), doubt
    return time, width, undecided
