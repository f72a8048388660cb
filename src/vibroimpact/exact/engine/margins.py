"""Compute the smallest errors of the state that would change the event sequence of a run.

Such an error changes what happens at an event, at a turn, or at the start or the end of the run. The constraint of a
module is the gap between ball and wall while the ball flies, and the contact force while the ball sticks. A turn is a
minimum of a constraint.

To find all turns, a flight is cut into pieces. In a piece, the rate of the constraint or the derivative of this rate
certainly keeps its sign. A piece therefore has at most one turn. The signs of the rate at both ends of a piece show
whether the piece has a turn. The proof that a sign is kept uses Bernstein coefficients of Taylor polynomials, as in the
module `exclusion`.
"""

import math

import numpy as np

from vibroimpact.exact.engine.compiled import compiled, inlined, inlined_source
from vibroimpact.exact.engine.contact import PHASE, Motion, box_accelerations, drift_balls, pair
from vibroimpact.exact.engine.exclusion import (
    DOUBT_FACTOR,
    LOOKAHEAD,
    acceleration_rounding,
    gap_rounding,
    least,
    own_remainder,
    remainder,
)  # fmt: skip
from vibroimpact.exact.engine.flow import advance, advance_phase, inverse_masses, jet, mode_of, value
from vibroimpact.exact.engine.variation import FORCING, LENGTH, completes_chatter, end_of, start_of
from vibroimpact.system.state import IMPACT, RELEASE

SHORTEST = 1e-9  # shortest piece of a flight, in units of `Flow.unit`; rounding hides the motion in a shorter piece
TURN_TOLERANCE = 1e-10  # tolerance for the time of a turn, in units of `Flow.unit`; the gap is then exact to 1e-20
NEGLIGIBLE_DOUBT = 1e-17  # truncation errors below 1e-17 in a gap or contact force are lost in rounding
MOST_STEPS = 60
GAP, FORCE, DOUBTS = 0, 1, 2


@compiled
def turning_points(flow, flights):
    """Return the smallest gap, the smallest contact force and the number of doubtful turns of each flight.

    flights: rows from `replayed`, shape (m + 1, COLUMNS). The result has shape (m + 1, 3).
    A turn is a minimum of a gap or of a contact force (per ball mass) in a flight. The smallest values are taken over
    the turns. They are inf if there is no turn. A turn is doubtful if rounding decides whether the ball misses the
    wall.
    """
    turns = np.empty((len(flights), 3))
    for n in range(len(flights)):
        turns[n, GAP], turns[n, FORCE], turns[n, DOUBTS] = math.inf, math.inf, 0.0
        boxes, balls, walls = start_of(flights[n])
        left, phase, tail = flights[n, LENGTH], flights[n, FORCING], 0.0
        while left > 0.0:
            t = min(left, flow.longest)
            motion = Motion(boxes, balls, walls, (0, 0), math.sin(phase), math.cos(phase))
            boxes, balls = _search(flow, motion, t, turns[n])
            phase, tail = advance_phase(phase, tail, flow.coefficients.omega, t)
            left -= t
    return turns


@inlined_source
def _search(flow, motion, length, least_of):
    """Search a part of a flight for turns (minima of the gap or of the contact force), and update `least_of`.

    Return the states of the boxes and of the balls at the end of the part.

    length: duration of the part, at most `flow.longest`. least_of: row of the result of `turning_points`.
    """
    q, walls = flow.coefficients, motion.walls
    mode = mode_of(walls)
    now, there, t = motion.boxes, motion.balls, 0.0
    sides, fastest, jets = (0.0, 0.0), q.omega**6, jet(q, mode, motion.boxes, motion.sine, motion.cosine)
    while t < length:
        step = min(length - t, LOOKAHEAD * flow.unit)
        both = remainder(q, mode, jets, step * q.growth)
        own1 = own_remainder(q, mode, jets, both, 0, abs(q.f1) * fastest, step)
        own2 = own_remainder(q, mode, jets, both, 1, abs(q.f2) * fastest, step)
        rate1, doubt1 = _rate(q, jets, now, there, walls, 0, own1)
        rate2, doubt2 = _rate(q, jets, now, there, walls, 1, own2)
        while not (_turns_once(rate1, doubt1, step) and _turns_once(rate2, doubt2, step)):
            step *= 0.5
            if step < SHORTEST * flow.unit:
                break
        sides = (rate1[0] if rate1[0] != 0.0 else sides[0], rate2[0] if rate2[0] != 0.0 else sides[1])
        end = t + step if t + step > t else length
        now, s, c = advance(flow, mode, motion.boxes, motion.sine, motion.cosine, end)
        there, jets = drift_balls(motion.balls, walls, now, end), jet(q, mode, now, s, c)
        for i in range(2):
            rate = _rate(q, jets, now, there, walls, i, 0.0)[0][0]
            if rate * sides[i] < 0.0:
                _note(flow, motion, i, (t, end), (sides[i], rate), least_of)
            if rate != 0.0:
                sides = pair(sides, i, rate)
        t = end
    return now, there


@inlined
def _rate(q, jets, boxes, balls, walls, i, bound):
    """Return the eight Taylor coefficients of the rate in module i, and bounds on the errors of the coefficients.

    The rate is X_i' - Y_i' while the ball flies, and X_i''' while the ball sticks. Up to its sign, this is the rate of
    the gap or of the contact force per ball mass.

    bound: bound on |X_i^(7)| / 7!.
    """
    p = jets[0] if i == 0 else jets[1]
    if walls[i] != 0:
        polynomial = 6.0 * p[3], 24.0 * p[4], 60.0 * p[5], 120.0 * p[6], 0.0, 0.0, 0.0, 0.0
        return polynomial, (0.0, 0.0, 0.0, 0.0, 210.0 * bound, 0.0, 0.0, 0.0)
    speed, bend = boxes[2 + i] - balls[2 + i], 2.0 * p[2]
    if speed == 0.0 and abs(bend) <= acceleration_rounding(q, boxes, i):  # this is the case just after a release
        bend = 0.0
    polynomial = speed, bend, 3.0 * p[3], 4.0 * p[4], 5.0 * p[5], 6.0 * p[6], 0.0, 0.0
    return polynomial, (0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 7.0 * bound, 0.0)


@inlined
def _turns_once(rate, doubt, t):
    """Return True if a rate certainly changes its sign at most once on [0, t].

    rate: Taylor coefficients of the rate. doubt: bounds on the errors of these coefficients.
    """
    if value(doubt, t) * t < NEGLIGIBLE_DOUBT:
        doubt = (0.0,) * 8
    if _one_sign(rate, doubt, t):
        return True
    return _one_sign(_derivative(rate), _derivative(doubt), t)


@inlined
def _one_sign(c, e, t):
    """Return True if all polynomials with coefficients from c - e to c + e certainly have the same sign on [0, t]."""
    return least(_minus(c, e), t) >= 0.0 or least(_minus(_minus((0.0,) * 8, c), e), t) >= 0.0


@inlined
def _minus(a, b):
    return a[0] - b[0], a[1] - b[1], a[2] - b[2], a[3] - b[3], a[4] - b[4], a[5] - b[5], a[6] - b[6], a[7] - b[7]


@inlined
def _derivative(c):
    return c[1], 2.0 * c[2], 3.0 * c[3], 4.0 * c[4], 5.0 * c[5], 6.0 * c[6], 7.0 * c[7], 0.0


@inlined_source
def _note(flow, motion, i, times, rates, least_of):
    """Find the zero of the rate of module i (`_rate`) between two times.

    times, rates: the two times, and the rates at these times, which have opposite signs.
    If the constraint has a minimum at the zero, record the minimum in `least_of`.
    """
    q, walls, balls, mode = flow.coefficients, motion.walls, motion.balls, mode_of(motion.walls)
    (low, high), (early, late) = times, rates
    t = low + (high - low) * abs(early) / (abs(early) + abs(late))
    for _ in range(MOST_STEPS):  # Newton's method for a zero of the rate; t stays between `low` and `high`
        x, s, c = advance(flow, mode, motion.boxes, motion.sine, motion.cosine, t)
        jets = jet(q, mode, x, s, c)
        p = jets[0] if i == 0 else jets[1]
        rate, bend = (p[1] - balls[2 + i], 2.0 * p[2]) if walls[i] == 0 else (6.0 * p[3], 24.0 * p[4])
        if rate * early > 0.0:
            low = t
        else:
            high = t
        newton = t - rate / bend if bend != 0.0 else low
        before, t = t, (newton if low < newton < high else 0.5 * (low + high))
        if abs(t - before) <= TURN_TOLERANCE * flow.unit:
            break
    x, s, c = advance(flow, mode, motion.boxes, motion.sine, motion.cosine, t)
    if walls[i] != 0:
        force = walls[i] * 2.0 * (jet(q, mode, x, s, c)[0 if i == 0 else 1])[2]
        if walls[i] * early < 0.0:
            least_of[FORCE] = min(least_of[FORCE], force)
        return
    y = drift_balls(balls, walls, x, t)
    relative = x[i] - y[i]
    if relative * early > 0.0:
        gap = 1.0 - abs(relative)
        least_of[GAP] = min(least_of[GAP], gap)
        least_of[DOUBTS] += gap <= DOUBT_FACTOR * gap_rounding(q, x, y, i)


@compiled
def margins_of(q, flights, turns, events, start_phase, duration):
    """Return (margins, depths, doubts) of the m + 1 flights and m events of a run.

    margins: smallest errors of the state that would change the event sequence, shape (m + 1, 2). Column 0 is for
    the start and column 1 for the end of each flight.
    depths: distances by which a ball would move beyond the wall if there were no wall, shape (m,). A depth is
    u^2 / (2 b), with the relative speed u and the deceleration b. If there is no deceleration, or if the event is not
    an impact, the depth is inf.
    doubts: 1 if rounding decides whether the ball hits the wall, otherwise 0, shape (m,).
    """
    margins = np.full((len(flights), 2), math.inf)
    depths, doubts = np.full(len(events), math.inf), np.zeros(len(events))
    for n in range(len(flights)):
        boxes, balls, walls = start_of(flights[n])
        for i in range(2):
            if walls[i] != 0:  # an error may turn a minimum of the contact force into a release
                _lower(margins[n], turns[n, FORCE] / _force_weight(q, walls, i))
        _lower(margins[n], turns[n, GAP])  # an error may turn a minimum of the gap into an impact
        if n == 0:
            margins[n, 0] = min(margins[n, 0], _at_start(q, boxes, balls, start_phase))
        elif events[n - 1, 3] == IMPACT:
            other = 2 - int(events[n - 1, 1])
            if walls[other] != 0:  # an error may change whether the impact releases the other ball
                margins[n, 0] = min(margins[n, 0], abs(_force(q, walls, boxes, events[n - 1, PHASE], other)))
        boxes, balls = end_of(flights[n])
        if n < len(events):
            i = int(events[n, 1]) - 1
            force = events[n, 2] * box_accelerations(q, walls, boxes, math.sin(events[n, PHASE]))[i]
            if events[n, 3] == IMPACT and force < 0.0:
                depths[n] = (boxes[2 + i] - balls[2 + i]) ** 2 / (-2.0 * force)
                doubts[n] = depths[n] <= DOUBT_FACTOR * gap_rounding(q, boxes, balls, i)
            margin = min(depths[n], _of_event(q, walls, boxes, balls, events, n, force, duration - events[n, 0]))
        else:
            margin = _at_end(q, walls, boxes, balls, start_phase)
        margins[n, 1] = min(margins[n, 1], margin)
    return margins, depths, doubts


@inlined
def _lower(margins, margin):
    """Lower the margins at the start and at the end of a flight to `margin` where they are larger than `margin`."""
    for k in range(2):
        margins[k] = np.minimum(margins[k], margin)


@inlined_source
def _of_event(q, walls, boxes, balls, events, n, force, left):
    """Return the smallest error of the state that would delay event n until the end of the run.

    If event n is a release, an error that would prevent the release also counts. If event n is a stick event that does
    not complete a chatter, the result is inf.

    left: time from event n to the end of the run.
    """
    i, wall, kind = int(events[n, 1]) - 1, events[n, 2], events[n, 3]
    if kind == IMPACT:  # distance of the ball beyond the wall at the end of the run if this impact did not happen
        return left * (wall * (boxes[2 + i] - balls[2 + i]) + 0.5 * left * max(force, 0.0))
    if kind == RELEASE:
        change, bend = _changes(q, walls, boxes, events[n, PHASE], i)
        depth = 0.5 * change * change / (wall * bend) if wall * bend > 0.0 else math.inf
        return min(left * abs(change), depth) / _force_weight(q, walls, i)
    if completes_chatter(events, n):  # a chatter with rebound speed u takes the time 2 u / (force (1 - kappa))
        return 0.5 * left * force * (1.0 - q.kappa)
    return math.inf


@inlined_source
def _at_start(q, boxes, balls, phase):
    """Return the smallest error of the initial state that would change the contact state of a ball."""
    margin = math.inf
    for i in range(2):
        gap, speed = 1.0 - abs(boxes[i] - balls[i]), abs(boxes[2 + i] - balls[2 + i])
        if gap == 0.0 and speed == 0.0:
            margin = min(margin, abs(_force(q, (0, 0), boxes, phase, i)))
        else:
            margin = min(margin, max(gap, speed))
    return margin


@inlined_source
def _at_end(q, walls, boxes, balls, phase):
    """Return the smallest error of the final state that would cause another event before the end of the run."""
    margin = math.inf
    for i in range(2):
        relative, speed = boxes[i] - balls[i], boxes[2 + i] - balls[2 + i]
        if walls[i] == 0:
            if relative * speed >= 0.0:
                margin = min(margin, abs(1.0 - abs(relative)))
        elif walls[i] * _changes(q, walls, boxes, phase, i)[0] <= 0.0:
            margin = min(margin, abs(_force(q, walls, boxes, phase, i)))
    return margin


@inlined
def _force(q, walls, boxes, phase, i):
    """Return the error of the state that would make the acceleration of box i zero.

    The error is the acceleration divided by `_force_weight`; it has the sign of the acceleration.
    """
    return box_accelerations(q, walls, boxes, math.sin(phase))[i] / _force_weight(q, walls, i)


@inlined
def _force_weight(q, walls, i):
    """Return the largest change of the acceleration of box i due to an error of norm 1 in the state of the boxes."""
    one, two = inverse_masses(q, mode_of(walls))
    if i == 0:
        return one * math.sqrt(q.k11 * q.k11 + q.k12 * q.k12 + q.c11 * q.c11 + q.c12 * q.c12)
    return two * math.sqrt(q.k22 * q.k22 + q.k12 * q.k12 + q.c22 * q.c22 + q.c12 * q.c12)


@inlined
def _changes(q, walls, boxes, phase, i):
    """Return the first and the second time derivative of the acceleration of box i."""
    p = jet(q, mode_of(walls), boxes, math.sin(phase), math.cos(phase))[0 if i == 0 else 1]
    return 6.0 * p[3], 24.0 * p[4]
