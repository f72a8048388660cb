"""Every turn of a run: where the gap between a ball and a wall, or the force that holds a sticking ball, is least.

A flight is cut into pieces in which the rate of each constraint certainly keeps its sign, or its rate does, so that it
turns once at most and the signs at both ends tell. The rates are bounded by their Taylor polynomials and the bound on
the seventh derivative of the boxes, in the Bernstein basis, as the flight itself was proved (exclusion).
"""

import math

import numpy as np

from vibroimpact.exact.engine.compiled import compiled, inlined, unfolded
from vibroimpact.exact.engine.constraints import (
    LOOKAHEAD,
    acceleration_rounding,
    gap_rounding,
    own_remainder,
    remainder,
)
from vibroimpact.exact.engine.exclusion import least
from vibroimpact.exact.engine.flow import advance, jet, value
from vibroimpact.exact.engine.motion import Motion, carry, mode_of, pair
from vibroimpact.exact.engine.phase import ahead
from vibroimpact.exact.engine.replay import FORCING, LENGTH, start_of

SHORTEST = 1e-9  # in units of the flow: over so short a piece nothing moves by more than rounding
SHARP = 1e-10  # in units of the flow: a gap is stationary at its turn, so half the digits of the time give all of it
UNSEEN = 1e-17  # a constraint that is known so well is known to rounding
MOST_STEPS = 60
GAP, FORCE, DOUBTS = 0, 1, 2


@compiled
def turning_points(flow, flights):
    """For each flight of a course the least gap and the least force (per unit of ball mass) at a turn, inf if there is
    none, and the number of turns within rounding of a wall: rows (m + 1, 3).
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
            phase, tail = ahead(phase, tail, flow.coefficients.omega, t)
            left -= t
    return turns


@unfolded
def _search(flow, motion, length, least_of):
    """Note the turns of a flight no longer than flow.longest; boxes and balls at its end."""
    q, walls = flow.coefficients, motion.walls
    mode = mode_of(walls)
    now, there, s, c, t = motion.boxes, motion.balls, motion.sine, motion.cosine, 0.0
    sides, fastest = (0.0, 0.0), q.omega**6
    while t < length:
        jets = jet(q, mode, now, s, c)
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
        there = carry(motion.balls, walls, now, end)
        for i in range(2):
            rate = _rate_at(q, walls, now, there, s, c, i)
            if rate * sides[i] < 0.0:
                _note(flow, motion, i, (t, end), (sides[i], rate), least_of)
            if rate != 0.0:
                sides = pair(sides, i, rate)
        t = end
    return now, there


@inlined
def _rate(q, jets, boxes, balls, walls, i, bound):
    """The rate of module i's constraint, but for the sign of the wall: (polynomial (8,), bounds (8,) on its error).

    The constraint is the gap of a flying ball, the acceleration of the box of a sticking one. A rate that vanishes
    within rounding, together with the rate of its own, is that of a ball just released.
    """
    p = jets[0] if i == 0 else jets[1]
    if walls[i] != 0:
        polynomial = 6.0 * p[3], 24.0 * p[4], 60.0 * p[5], 120.0 * p[6], 0.0, 0.0, 0.0, 0.0
        return polynomial, (0.0, 0.0, 0.0, 0.0, 210.0 * bound, 0.0, 0.0, 0.0)
    speed, bend = boxes[2 + i] - balls[2 + i], 2.0 * p[2]
    if speed == 0.0 and abs(bend) <= acceleration_rounding(q, boxes, i):
        bend = 0.0
    polynomial = speed, bend, 3.0 * p[3], 4.0 * p[4], 5.0 * p[5], 6.0 * p[6], 0.0, 0.0
    return polynomial, (0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 7.0 * bound, 0.0)


@inlined
def _turns_once(rate, doubt, t):
    """Whether a rate, known but for the doubt, changes its sign at most once on [0, t], certainly."""
    if value(doubt, t) * t < UNSEEN:
        doubt = (0.0,) * 8
    if _one_sign(rate, doubt, t):
        return True
    return _one_sign(_derivative(rate), _derivative(doubt), t)


@inlined
def _one_sign(c, e, t):
    """Whether a polynomial c (8,), known but for e (8,), is certainly of one sign (or zero) on [0, t]."""
    return least(_minus(c, e), t) >= 0.0 or least(_minus(_minus((0.0,) * 8, c), e), t) >= 0.0


@inlined
def _minus(a, b):
    return a[0] - b[0], a[1] - b[1], a[2] - b[2], a[3] - b[3], a[4] - b[4], a[5] - b[5], a[6] - b[6], a[7] - b[7]


@inlined
def _derivative(c):
    return c[1], 2.0 * c[2], 3.0 * c[3], 4.0 * c[4], 5.0 * c[5], 6.0 * c[6], 7.0 * c[7], 0.0


@inlined
def _rate_at(q, walls, boxes, balls, sine, cosine, i):
    """The rate of module i's constraint at a point of a flight, but for the sign of the wall."""
    if walls[i] == 0:
        return boxes[2 + i] - balls[2 + i]
    jets = jet(q, mode_of(walls), boxes, sine, cosine)
    return 6.0 * (jets[0] if i == 0 else jets[1])[3]


@unfolded
def _note(flow, motion, i, times, rates, least_of):
    """Find the turn of module i between two times of a flight, given the rates there; note it if it is a minimum."""
    q, walls, balls, mode = flow.coefficients, motion.walls, motion.balls, mode_of(motion.walls)
    (low, high), (early, late) = times, rates
    t = low + (high - low) * abs(early) / (abs(early) + abs(late))
    for _ in range(MOST_STEPS):  # Newton on the rate, kept between the ends
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
        if abs(t - before) <= SHARP * flow.unit:
            break
    x, s, c = advance(flow, mode, motion.boxes, motion.sine, motion.cosine, t)
    if walls[i] != 0:
        force = walls[i] * 2.0 * (jet(q, mode, x, s, c)[0 if i == 0 else 1])[2]
        if walls[i] * early < 0.0:
            least_of[FORCE] = min(least_of[FORCE], force)
        return
    y = carry(balls, walls, x, t)
    relative = x[i] - y[i]
    if relative * early > 0.0:
        gap = 1.0 - abs(relative)
        least_of[GAP] = min(least_of[GAP], gap)
        least_of[DOUBTS] += gap <= gap_rounding(q, x, y, i)
