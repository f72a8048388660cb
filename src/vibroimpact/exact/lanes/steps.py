"""Advance eight runs in parallel lanes through free flights and simple impacts; each lane has its own system.

Between impacts, a step h multiplies z = [X1, X2, X1', X2', sin, cos] by exp(A h) (`advance_lanes`). Only the change of
z is computed and added, so that the rounding error is small.

A step needs a proof that no impact happens in it. Let w be the difference of box and ball position in a module, and r
the rate of w. The values of w and r at both ends of the step define Hermite's cubic polynomial. The polynomial lies
between the smallest and the largest of its Bernstein coefficients w, w + h r / 3, w' - h r' / 3, w', where a prime
marks the end of the step. Let B bound the fourth derivative of w. At the fraction s of the step, the error of the
polynomial is at most B h^4 s^2 (1 - s)^2 / 24. The walls are at w = +-1. The proof requires that the two middle
coefficients are at most 1 - B h^4 / 72 in magnitude. Their total weight in the polynomial is 3 s (1 - s). Therefore the
margin B h^4 / 72 covers the error. A bound on rounding errors is also subtracted from 1. B follows from the energy of
the boxes, which grows by at most the work of the force.

A lane waits if its next step has no proof. Once enough lanes wait, `step_to_event` advances all waiting lanes in one
pass. Taylor polynomials of both boxes give the time of an impact. The Bernstein coefficients up to this time prove that
no impact happens earlier. If this proof fails, the next pass tries a step of half the duration. The event loop
handles all other cases: the completion of a chatter (impacts at one wall in ever shorter flights), balls at rest on a
wall, simultaneous events, and any doubt.

`vibroimpact.system.restitution` lists all implementations of the impact law, such as the one here.
"""

import math
from typing import NamedTuple

from vibroimpact.exact.engine.compiled import in_place, inlined
from vibroimpact.exact.engine.contact import HIGHEST_HOP
from vibroimpact.exact.engine.exclusion import CONVERGING, LOOKAHEAD
from vibroimpact.exact.engine.flow import (
    QUARTER,
    QUARTER_TAIL,
    TWO_PI,
    TWO_PI_TAIL,
    advance_phase,
    reduced,
    sine_and_cosine_near,
)
from vibroimpact.exact.engine.vectors import Lanes, Mask, count, fused, load, load_rows, replace_rows, store, where
from vibroimpact.exact.lanes import rows
from vibroimpact.exact.lanes.rows import LARGEST, ORDER, SECOND, STATISTICS_AT, evaluate, expand, least, most
from vibroimpact.exact.lanes.statistics import keep_turns, may_turn_beyond, observe

RUNNING, WAITING, STOPPED, DOUBTFUL = 0.0, 1.0, 2.0, 3.0
"""State of a lane before and after a pass.

RUNNING: the run goes on. WAITING: the next step is not proved to be free of impacts, so that the lane waits for a pass.
STOPPED: the run has reached the end of a window. DOUBTFUL: the lane needs the event loop."""

SHORTEST = 1 / 32  # if the proof fails for this fraction of a step or less, the event loop continues the run
LONGEST = 6.0  # largest phase change [rad] in a flight, below 2 pi; the next flight computes sine and cosine anew
ROUNDED = 8.0 * 2.0**-52  # relative bound on the rounding error of a few operations
SAME_TIME = 2.0**-48  # a run stops if at most this time remains until the end of a window


@in_place
def advance_lanes(runs, c, work, enough):
    """Advance the runs in all lanes step by step, until `enough` lanes wait; return the number of steps.

    A lane waits if its next step is not proved to be free of impacts. runs: numbers of the runs, shape (STATES, 8).
    c: constants of their systems, shape (CONSTANTS, 8).
    """
    x1, x2, v1, v2, y1, y2, u1, u2, s, k = load_rows(runs, rows.X1, 10)
    passed, reach, trial = load_rows(runs, rows.PASSED, 3)
    limit, step, third = load(runs, rows.LIMIT), load(c, rows.STEP), load(c, rows.STEP) * (1 / 3)
    alive, ready = load(runs, rows.ALIVE) > 0.0, (trial == step) & (load(runs, rows.DUE) < 0.0)
    most1, most2 = _records(runs)
    square = step * step
    less = fused(load(c, rows.BEND), square * square, load(c, rows.ROUNDING)) * (load(c, rows.DRIVE) * step)
    ca, sa = load(c, rows.CA), load(c, rows.SA)
    w1, w2, r1, r2 = x1 - fused(passed, u1, y1), x2 - fused(passed, u2, y2), v1 - u1, v2 - u2
    steps = 0
    while True:
        # A step and its proof are computed in all lanes.
        a1, a2 = x1 + _change(c, 0, x1, x2, v1, v2, s, k), x2 + _change(c, 1, x1, x2, v1, v2, s, k)
        b1, b2 = v1 + _change(c, 2, x1, x2, v1, v2, s, k), v2 + _change(c, 3, x1, x2, v1, v2, s, k)
        later = passed + step
        q1, q2 = a1 - fused(later, u1, y1), a2 - fused(later, u2, y2)
        o1, o2 = b1 - u1, b2 - u2
        ok = ready & (later <= reach) & (abs(q1) <= limit) & (abs(q2) <= limit)
        ok = ok & _inside(limit, w1, r1, q1, o1, third) & _inside(limit, w2, r2, q2, o2, third)
        if count(alive & ~ok) >= enough:
            break
        # Store the turning points at which a box may exceed its largest displacement so far.
        wrong, s_later, k_later = 1.0 - limit, s + fused(k, sa, s * ca), k + fused(k, ca, -s * sa)
        turns1 = ok & may_turn_beyond(most1 - wrong, x1, v1, a1, b1, third)
        turns2 = ok & may_turn_beyond(most2 - wrong, x2, v2, a2, b2, third)
        if count(turns1 | turns2) > 0:
            early, late = (x1, x2, v1, v2, s, k), (a1, a2, b1, b2, s_later, k_later)
            keep_turns(runs, c, work, (turns1, turns2), wrong, early, late, step)
            most1, most2 = _records(runs)
        # Take the step only in lanes where the step is proved to be free of impacts.
        s, k = where(ok, s_later, s), where(ok, k_later, k)
        x1, x2, v1, v2 = where(ok, a1, x1), where(ok, a2, x2), where(ok, b1, v1), where(ok, b2, v2)
        passed, limit = where(ok, later, passed), where(ok, limit - less, limit)
        w1, w2, r1, r2 = where(ok, q1, w1), where(ok, q2, w2), where(ok, o1, r1), where(ok, o2, r2)
        steps += 1
    replace_rows(runs, rows.TOUCH1, passed > load(runs, rows.PASSED), (0.0, 0.0))
    replace_rows(runs, rows.X1, alive, (x1, x2, v1, v2))
    replace_rows(runs, rows.SINE, alive, (s, k))
    replace_rows(runs, rows.PASSED, alive, (passed,))
    replace_rows(runs, rows.LIMIT, alive, (limit,))
    store(runs, rows.OUTCOME, where(alive & ~ok, WAITING, RUNNING))
    return steps


@inlined
def _records(runs):
    """Return the largest displacements of both boxes so far; they are inf in lanes whose run is not observed."""
    watched, largest = load(runs, rows.WATCHED) > 0.0, load_rows(runs, STATISTICS_AT + LARGEST, 2)
    return where(watched, largest[0], math.inf), where(watched, largest[1], math.inf)


class Bodies(NamedTuple):
    """Positions and velocities of both boxes (x, v) and both balls (y, u)."""

    x1: Lanes
    x2: Lanes
    v1: Lanes
    v2: Lanes
    y1: Lanes
    y2: Lanes
    u1: Lanes
    u2: Lanes


class Contact(NamedTuple):
    """End of a step in each lane; the end may be an impact.

    time: duration of the step.
    meets: True if a ball meets a wall at the end of the step.
    missed: True if an impact is expected but its time is not found.
    first: True if the ball that meets a wall is in module 1.
    walls: for each ball, the wall that it approaches.
    at_once: True if a ball is already on its wall, so that `time` is 0.
    """

    time: Lanes
    meets: Mask
    missed: Mask
    first: Mask
    walls: tuple[Lanes, Lanes]
    at_once: Mask


class Clock(NamedTuple):
    """Forcing phase and time of the run in each lane.

    phase, tail: forcing phase and its rounding remainder.
    turns: number of times that the phase has passed 2 pi.
    sine, cosine: sine and cosine of the phase.
    left: time until the run stops.
    """

    phase: Lanes
    tail: Lanes
    turns: Lanes
    sine: Lanes
    cosine: Lanes
    left: Lanes


@in_place
def step_to_event(runs, c, work, integrals):
    """Advance each waiting run to the next impact, or by its trial step if no impact is found in this step.

    If an earlier impact cannot be excluded, the run does not move, and the next trial step is half as long.
    Return the number of runs that need the event loop or are at the end of a window.
    """
    pending, leaves = load(runs, rows.OUTCOME) == WAITING, load(runs, rows.TRIAL) < 0.0
    x1, x2, v1, v2, y1, y2, u1, u2, s, k = load_rows(runs, rows.X1, 10)
    passed = load(runs, rows.PASSED)
    now = Bodies(x1, x2, v1, v2, fused(passed, u1, y1), fused(passed, u2, y2), u1, u2)
    expand(c, x1, x2, v1, v2, s, k, work)

    end = _locate(runs, c, work, now, leaves)
    elapsed = passed + end.time
    then, lows = _arrive(runs, work, end.time, elapsed)
    size = fused(elapsed, load(c, rows.DRIVE), load(runs, rows.SIZE))
    rounding = _rounding(c, size, u1, u2)
    limit = _limit(c, size, end.time, rounding)
    proved = _prove(now, then, end, limit, rounding)
    clock = _advance_clock(runs, c, elapsed)
    wall, box, ball, plain = _collide(c, then, end, clock, rounding)

    done = pending & (proved | leaves)
    hits, doubt = done & end.meets & plain, done & end.meets & ~plain
    hit1, hit2 = hits & end.first, hits & ~end.first
    stops = done & ~end.meets & ~leaves & (elapsed >= load(runs, rows.REACH)) & (clock.left <= SAME_TIME)
    after = Bodies(
        then.x1, then.x2, where(hit1, box, then.v1), where(hit2, box, then.v2),
        where(hit1, then.x1 - wall, then.y1), where(hit2, then.x2 - wall, then.y2),
        where(hit1, ball, u1), where(hit2, ball, u2),
    )  # fmt: skip
    if integrals > 0:
        flight, early = (done, end.time, elapsed, 1.0 - limit), (x1, x2, v1, v2, s, k)
        late = then[:2], then[2:4], after[2:4], (u1, u2), (clock.sine, clock.cosine)
        observe(runs, c, work, integrals, flight, (hit1, hit2), early, late)
    _begin_flight(runs, c, done, after, clock)
    again = pending & ~done & (end.time > SHORTEST * load(c, rows.STEP))
    trial = where(done, load(c, rows.STEP), where(again, 0.5 * end.time, -1.0))
    replace_rows(runs, rows.TRIAL, pending, (trial,))
    replace_rows(runs, rows.Y1_LOW, done, (where(hit1, 0.0, lows[0]), where(hit2, 0.0, lows[1])))
    replace_rows(runs, rows.TOUCH1, done & (end.time > 0.0), (0.0, 0.0))
    replace_rows(runs, rows.TOUCH1, hit1, (wall,))
    replace_rows(runs, rows.TOUCH2, hit2, (wall,))
    due = where(leaves, load(runs, rows.DUE), -1.0)
    replace_rows(runs, rows.DUE, done, (where(doubt, where(end.first, 0.0, 1.0), due),))
    replace_rows(runs, rows.EVENTS, hits, (load(runs, rows.EVENTS) + 1.0,))
    replace_rows(runs, rows.STALLED, done & (elapsed > 0.0), (0.0,))
    out = doubt | (done & leaves)
    store(runs, rows.OUTCOME, where(out, DOUBTFUL, where(stops, STOPPED, RUNNING)))
    return count(out | stops)


@inlined
def _locate(runs, c, work, now, leaves):
    """Return the Contact at the end of the trial step in each lane.

    The step ends at the next impact. If no impact is found, the step has the longest duration that is allowed.
    """
    x1, x2, v1, v2, y1, y2, u1, u2 = now
    (touch1, touch2), (s, k) = load_rows(runs, rows.TOUCH1, 2), load_rows(runs, rows.SINE, 2)
    due, step = load(runs, rows.DUE), load(c, rows.STEP)
    at_once = (due >= 0.0) & ~leaves
    until = least(most(load(runs, rows.TRIAL), 0.0), load(runs, rows.REACH) - load(runs, rows.PASSED))
    a1 = x1 - fused(step, u1, y1) + _rough_change(c, 0, x1, x2, v1, v2, s, k)
    a2 = x2 - fused(step, u2, y2) + _rough_change(c, 1, x1, x2, v1, v2, s, k)
    wall1, wall2 = where(a1 > 0.0, 1.0, -1.0), where(a2 > 0.0, 1.0, -1.0)
    t1 = where(abs(a1) >= 1.0, _approximate_time(work, 0, touch1 == wall1, wall1, y1, u1, step), math.inf)
    t2 = where(abs(a2) >= 1.0, _approximate_time(work, SECOND, touch2 == wall2, wall2, y2, u2, step), math.inf)
    first = where(at_once, due, where(t1 <= t2, 0.0, 1.0)) == 0.0
    wall, soonest = where(first, wall1, wall2), least(t1, t2)
    ball, rate = where(first, y1, y2), where(first, u1, u2)
    near = where(where(first, touch1, touch2) == wall, 0.0, where(first, x1, x2) - ball - wall)
    t, found = _refined_time(work, first, near, where(first, v1, v2) - rate, soonest)
    found = found & (soonest <= step) & (t > 0.0) & (t <= until)
    time = where(at_once, 0.0, where(found, t, until))
    return Contact(time, found | at_once, (soonest <= until) & ~found, first, (wall1, wall2), at_once)


@inlined
def _arrive(runs, work, t, elapsed):
    """Return the Bodies after a step of duration t, and the rounding remainders of the ball positions.

    elapsed: time from the start of the flight to the end of the step.
    """
    x1, v1 = evaluate(work, 0, t)
    x2, v2 = evaluate(work, SECOND, t)
    y1, y2, u1, u2 = load_rows(runs, rows.Y1, 4)
    low1, low2 = load_rows(runs, rows.Y1_LOW, 2)
    z1, low1 = _drifted(y1, low1, u1, elapsed)
    z2, low2 = _drifted(y2, low2, u2, elapsed)
    return Bodies(x1, x2, v1, v2, z1, z2, u1, u2), (low1, low2)


@inlined
def _prove(now, then, end, limit, rounding):
    """Return a mask of the lanes where certainly no ball meets a wall before the end of the step."""
    t, third = end.time, end.time * (1 / 3)
    meets1, meets2 = end.meets & end.first, end.meets & ~end.first
    w1, w2 = then.x1 - then.y1, then.x2 - then.y2
    r1, r2 = then.v1 - then.u1, then.v2 - then.u2
    ok = _inside(limit, now.x1 - now.y1, now.v1 - now.u1, where(meets1, end.walls[0], w1), r1, third)
    ok = ok & _inside(limit, now.x2 - now.y2, now.v2 - now.u2, where(meets2, end.walls[1], w2), r2, third)
    ok = (ok & ~end.missed) | (t == 0.0)
    return ok & (meets1 | (abs(w1) <= 1.0 - rounding)) & (meets2 | (abs(w2) <= 1.0 - rounding))


@inlined
def _advance_clock(runs, c, elapsed):
    """Return the Clock at the time `elapsed` after the start of a flight."""
    phase, tail, turns = load_rows(runs, rows.PHASE, 3)
    phase, tail = advance_phase(phase, tail, load(c, rows.OMEGA), elapsed)
    full, (less, rest) = phase >= TWO_PI, reduced(phase, tail)
    phase, tail, turns = where(full, less, phase), where(full, rest, tail), where(full, turns + 1.0, turns)
    sine, cosine = _sine_and_cosine(phase, tail)
    whole = load(runs, rows.STOP) - turns
    since = (phase - load(c, rows.FIRST)) + (tail - load(c, rows.FIRST_TAIL))
    left = (whole * TWO_PI - since + whole * TWO_PI_TAIL) / load(c, rows.OMEGA)
    return Clock(phase, tail, turns, sine, cosine, left)


@inlined
def _collide(c, then, end, clock, rounding):
    """Return the wall of the impact, the box and ball velocities after the impact, and the mask `plain`.

    `plain` is False in two cases. First, the impact begins a chatter (impacts at one wall in ever shorter flights) that
    ends soon. Second, the relative velocity before or after the impact may be a rounding error.
    """
    x1, x2, v1, v2, y1, y2, u1, u2 = then
    kappa, epsilon = load(c, rows.KAPPA), load(c, rows.EPSILON)
    ahead = where(end.first, end.walls[0], end.walls[1])
    wall = where(end.at_once, where(where(end.first, x1 - y1, x2 - y2) > 0.0, 1.0, -1.0), ahead)
    before, rate = where(end.first, v1, v2), where(end.first, u1, u2)
    approach = before - rate
    gained = fused(load(c, rows.IMPULSE), approach, load(c, rows.REST) * approach)
    heavy, lower = epsilon > 1.0, fused(-epsilon, gained, before)
    ball = where(heavy, rate + gained, fused(kappa, approach, lower))
    box = where(heavy, fused(-kappa, approach, ball), lower)
    plain = wall * approach > ROUNDED * (abs(before) + abs(rate))
    plain = plain & (kappa * abs(approach) > ROUNDED * (abs(approach) + abs(box) + abs(ball)))

    e1, e2 = where(end.meets & end.first, box, v1), where(end.meets & ~end.first, box, v2)
    k11, k12, k22, c11, c12, c22 = (*load_rows(c, rows.K11, 3), *load_rows(c, rows.C11, 3))
    force1 = load(c, rows.F1) * clock.sine - k11 * x1 - k12 * x2 - c11 * e1 - c12 * e2
    force2 = load(c, rows.F2) * clock.sine - k12 * x1 - k22 * x2 - c12 * e1 - c22 * e2
    push, inward = wall * where(end.first, force1, force2), -wall * (box - ball)
    soon = 4.0 * inward <= push * (1.0 - kappa) * least(clock.left, LOOKAHEAD * load(c, rows.UNIT))
    plain = plain & ~(soon & (inward * inward <= 2.0 * push * (HIGHEST_HOP + 4.0 * rounding)))
    return wall, box, ball, plain


@inlined
def _begin_flight(runs, c, done, start, clock):
    """Write the start of the next flight to the rows of `runs`, in the lanes of the mask `done`.

    The rows also contain the limit on the Bernstein coefficients in the first step of the flight. start: Bodies at the
    start of the flight.
    """
    x1, x2, v1, v2, _, _, u1, u2 = start
    step, across = load(c, rows.STEP), x1 - x2
    energy = fused(x1, x1, load(c, rows.GROUND) * (x2 * x2))
    size = math.sqrt(fused(v1, v1, v2 * v2) + fused(-load(c, rows.K12), across * across, energy))
    later = fused(load(c, rows.DRIVE), step, size)
    limit = _limit(c, later, step, _rounding(c, later, u1, u2))
    reach = least(clock.left, LONGEST / load(c, rows.OMEGA))
    replace_rows(runs, rows.X1, done, start)
    replace_rows(runs, rows.SINE, done, (clock.sine, clock.cosine))
    replace_rows(runs, rows.PASSED, done, (0.0, reach))
    replace_rows(runs, rows.SIZE, done, (size, limit))
    replace_rows(runs, rows.PHASE, done, (clock.phase, clock.tail, clock.turns))


@inlined
def _limit(c, size, t, rounding):
    """Return the limit on the middle Bernstein coefficients of a step of duration t.

    size: bound on the square root of twice the energy of the boxes.
    """
    square = t * t
    bend = fused(load(c, rows.BEND), size, load(c, rows.BEND_FORCE))
    return 1.0 - fused(bend, square * square, rounding)


@inlined
def _change(c, k, x1, x2, v1, v2, s, cosine):
    """Return entry k < 4 of (exp(A h) - I) z, where z = [X1, X2, X1', X2', sin, cos].

    This entry is the change of z[k] in a step h.
    """
    low = _of_boxes(c, rows.LOW_PARTS + 4 * k, x1, x2, v1, v2)
    return _rough_change(c, k, x1, x2, v1, v2, s, cosine, low)


@inlined
def _rough_change(c, k, x1, x2, v1, v2, s, cosine, low=0.0):
    """Return entry k < 4 of (exp(A h) - I) z, where z = [X1, X2, X1', X2', sin, cos].

    low: contribution of the rounding remainders of exp(A h) - I to this entry. If it is 0, the result is less exact.
    """
    boxes = _of_boxes(c, 6 * k, x1, x2, v1, v2)
    return boxes + fused(load(c, 6 * k + 5), cosine, fused(load(c, 6 * k + 4), s, low))


@inlined
def _of_boxes(c, k, x1, x2, v1, v2):
    """Return the scalar product of the constants in the rows k to k + 3 with (x1, x2, v1, v2)."""
    return fused(load(c, k + 1), x2, load(c, k) * x1) + fused(load(c, k + 3), v2, load(c, k + 2) * v1)


@inlined
def _inside(limit, w, rate, later, rate_later, third):
    """Return True in lanes where both middle Bernstein coefficients are at most `limit` in magnitude.

    w, rate: position of a ball in its box, and its rate, before the step. later, rate_later: position and rate after
    the step. third: a third of the duration of the step.
    """
    return (abs(fused(third, rate, w)) <= limit) & (abs(fused(-third, rate_later, later)) <= limit)


@inlined
def _drifted(y, low, u, time):
    """Return the position of a ball after `time`, as a float and its rounding remainder.

    y, low: position of the ball at time 0 and its rounding remainder. u: velocity of the ball. Without remainders,
    rounding errors of equal flights would add up.
    """
    way = fused(time, u, low)
    there = y + way
    part = there - y
    return there, (y - (there - part)) + (way - part)


@inlined
def _rounding(c, size, u1, u2):
    """Return a bound on the rounding error of x_i - y_i in a flight.

    size: bound on the square root of twice the energy of the boxes. u1, u2: ball velocities.
    """
    return fused(load(c, rows.ROUNDING), size, load(c, rows.LEAST_ROUNDING)) + ROUNDED * (abs(u1) + abs(u2))


@inlined
def _approximate_time(work, first, leaves, wall, y, u, step):
    """Return the approximate time at which a ball meets a wall.

    leaves: True if the ball has just left this wall.
    """
    c0 = where(leaves, 0.0, 1.0 - wall * (load(work, first) - y))
    c1, c2 = -wall * (load(work, first + 1) - u), -wall * load(work, first + 2)
    root = fused(c1, c1, -4.0 * c0 * c2)
    t = where(leaves, -c1 / c2, 2.0 * c0 / (math.sqrt(where(root > 0.0, root, 0.0)) - c1))
    t = where((t > 0.0) & (t <= step), t, step)
    c3, c4, c5 = -wall * load(work, first + 3), -wall * load(work, first + 4), -wall * load(work, first + 5)
    for _ in range(2):
        value = fused(t, fused(t, fused(t, fused(t, fused(t, c5, c4), c3), c2), c1), c0)
        slope = fused(t, fused(t, fused(t, fused(t, 5.0 * c5, 4.0 * c4), 3.0 * c3), 2.0 * c2), c1)
        t = t - value / slope
    return t


@inlined
def _refined_time(work, one, near, speed, t):
    """Return the time at which a ball meets its wall, and True if Newton's method from t converges.

    one: True if the ball is in module 1. near, speed: position of the ball relative to its wall, and the rate of this
    position, at time 0.
    """
    t = t - _newton_step(work, one, near, speed, t, rows.TERMS + 2)  # the next step adds the neglected terms
    change = _newton_step(work, one, near, speed, t, ORDER)
    t = t - change
    return t, abs(change) <= CONVERGING * t


@inlined
def _newton_step(work, one, near, speed, t, order):
    """Return the Newton step of `_refined_time` at t; polynomial terms above the order `order` are neglected."""
    value, slope = where(one, load(work, order), load(work, SECOND + order)), 0.0 * t
    for m in range(order - 1, 1, -1):
        slope = fused(slope, t, value)
        value = fused(value, t, where(one, load(work, m), load(work, SECOND + m)))
    slope = fused(slope, t, value)
    value = fused(value, t, speed)
    slope = fused(slope, t, value)
    value = fused(value, t, near)
    return value / slope


@inlined
def _sine_and_cosine(phase, tail):
    """Return sine and cosine of phase + tail in each lane, computed as in `flow.sine_and_cosine`."""
    quarters = math.floor(phase * (1.0 / QUARTER) + 0.5)
    x, y = fused(-quarters, QUARTER, phase), tail - quarters * QUARTER_TAIL
    sine, cosine = sine_and_cosine_near(x, y)
    odd = (quarters == 1.0) | (quarters == 3.0)
    sine, cosine = where(odd, cosine, sine), where(odd, -sine, cosine)
    half = (quarters == 2.0) | (quarters == 3.0)
    return where(half, -sine, sine), where(half, -cosine, cosine)
