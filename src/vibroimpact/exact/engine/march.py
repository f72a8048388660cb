"""Advance eight runs in parallel lanes through free flights and simple impacts; each lane has its own system.

Between impacts each lane advances by its fixed step h, z' = exp(A h) z (`advance_lanes`); only the change of z is
added, so that its rounding is small. The hull of a cubic polynomial proves that a step has no impact. The position w of
a ball in its box and its rate r at both ends define Hermite's polynomial, which is bounded by its Bernstein
coefficients w, w + h r / 3, w' - h r' / 3, w'. With a bound B on the fourth derivative, its error is at most B h^4 s^2
(1 - s)^2 / 24 at the fraction s of the step; lowering the two middle coefficients by B h^4 / 72 covers more than that.
B follows from the energy of the boxes, which grows no faster than by the work of the force.

Lanes whose step is not proved wait until there are enough of them for a pass (`step_to_event`): the Taylor polynomials
of both boxes give the time of an impact, and the same hull proves the flight until then. If a proof fails, it is tried
again over half the time. All other cases (chatter to be completed, balls at rest, simultaneous events, any doubt) are
left to the event loop.

If the hull of a box exceeds its largest displacement so far, its turn is stored in the lane and computed later together
with those of the other lanes. No lane has to wait, and a larger turn may replace it.
"""

import math

from vibroimpact.exact.engine.compiled import in_place, inlined
from vibroimpact.exact.engine.contact import LOW
from vibroimpact.exact.engine.exclusion import CONVERGING, LOOKAHEAD
from vibroimpact.exact.engine.lanes import count, load, store, where
from vibroimpact.exact.engine.phase import (
    QUARTER,
    QUARTER_TAIL,
    TWO_PI,
    TWO_PI_TAIL,
    advance_phase,
    fused,
    reduced,
    sine_and_cosine_near,
)
from vibroimpact.exact.engine.statistics import IMPACTS, INTEGRALS, LARGEST, LOST, PATH, STATISTICS

X1, X2, V1, V2, Y1, Y2, U1, U2, SINE, COSINE = range(10)
Y1_LOW, Y2_LOW, PASSED, REACH, TRIAL, SIZE, LIMIT, TOUCH1, TOUCH2, DUE = range(10, 20)
PHASE, TAIL, TURNS, STOP, ALIVE, WATCHED, EVENTS, STALLED, OUTCOME, STATISTICS_AT = range(20, 30)
TURNS_AT = STATISTICS_AT + STATISTICS
SINCE, HIGHEST, KEPT, TURN = 6, 7, 8, 9
STATES = TURNS_AT + 2 * TURN
"""Rows of the runs, (STATES, 8): boxes; balls at the start of the flight; sine and cosine of the forcing phase;
remainders of the positions of the balls; time since the start of the flight, and time to its end; length of the next
step (0: begin a flight, -1: leave it to the event loop); bound on the energy of the boxes; limit for the Bernstein
coefficients; walls that the balls leave; module on a wall, or -1; phase at the start, with its tail; revolutions, and
those at which the run stops; 1 for a run; 1 if it is observed; its events; its flights without progress; result of a
pass; statistics; and, for each box, a turn that may be its largest displacement (`find_turns`): boxes and forcing at a
time near it, the approximate time from there to the turn, a bound on its displacement, and 1 if there is one."""

LOW_PARTS = 24
CA, SA, STEP, K11, K12, K22, C11, C12, C22, F1, F2, OMEGA, EPSILON, KAPPA, IMPULSE, REST, GROUND, DRIVE = range(40, 58)
BEND, BEND_FORCE, ROUNDING, LEAST_ROUNDING, UNIT, LOSS, FIRST, FIRST_TAIL, DRIFTS, DROPS = (*range(58, 67), 74)
CONSTANTS = DROPS + 12 * (STATISTICS - INTEGRALS)
"""Rows of the constants, (CONSTANTS, 8), of each system: exp(A h) - 1, four rows of six; the remainders of its columns
for the boxes, four rows of four, since every step would repeat this error; cos - 1 and sin of Omega h; h; scalars of
`flow.Coefficients`; B / 72 per bound on the energy and due to the force; rounding, in the same way; loss of an impact;
phase at the start; and, for each integral, its drift and the rows of its potential for both velocities."""

NOTHING, DONE, STOPPED, DOUBTFUL = 0.0, 1.0, 2.0, 3.0
"""Result of a pass in a lane; DOUBTFUL requires the event loop."""

LONGEST_STEP = 0.52  # times the largest rate of boxes and forcing
ORDER = next(n for n in range(1, 99) if LONGEST_STEP**n / math.factorial(n - 1) < 2.0**-53)
"""Order n of the Taylor polynomials over a time t <= LONGEST_STEP / r, where r bounds the rates of boxes and forcing.

The derivative of order n of a velocity is at most r^n E + n r^(n - 1) F, where E is the root of twice the energy of
the boxes and F the force. So the truncation error of a velocity is less than a rounding of E / n + F / r, and that of a
position is t / (n + 1) times as large.
"""
TERMS = 7  # terms that suffice for the time of a turn in a step
SHORTEST = 1 / 32  # smallest fraction of a step over which a proof is tried
LONGEST = 6.0  # forcing angle [rad], below a full turn, after which its sine and cosine are computed again
ROUNDED = 8.0 * 2.0**-52
SAME_TIME = 2.0**-48


@inlined
def _least(a, b):
    return where(a < b, a, b)


@inlined
def _most(a, b):
    return where(a > b, a, b)


@inlined
def _change(c, k, x1, x2, v1, v2, s, cosine):
    """Return row k of exp(A h) - 1 times [X1, X2, X1', X2', sin, cos]: the change of one of them in a step."""
    low = _of_boxes(c, LOW_PARTS + 4 * k, x1, x2, v1, v2)
    return _rough_change(c, k, x1, x2, v1, v2, s, cosine, low)


@inlined
def _rough_change(c, k, x1, x2, v1, v2, s, cosine, low=0.0):
    """Return `_change` without the rounding errors of the constants.

    low: their contribution, if it is needed.
    """
    boxes = _of_boxes(c, 6 * k, x1, x2, v1, v2)
    return boxes + fused(load(c, 6 * k + 5), cosine, fused(load(c, 6 * k + 4), s, low))


@inlined
def _of_boxes(c, k, x1, x2, v1, v2):
    """Return the product of four constants, from row k on, with the boxes."""
    return fused(load(c, k + 1), x2, load(c, k) * x1) + fused(load(c, k + 3), v2, load(c, k + 2) * v1)


@inlined
def _inside(limit, w, rate, later, rate_later, third):
    """Return True where the middle Bernstein coefficients are within a limit.

    third: a third of the time.
    """
    return (abs(fused(third, rate, w)) <= limit) & (abs(fused(-third, rate_later, later)) <= limit)


@inlined
def _may_turn_beyond(most, x, v, later, v_later, third):
    """Return True where a box turns in a step and a middle Bernstein coefficient exceeds `most`."""
    return (v * v_later < 0.0) & (_most(abs(fused(third, v, x)), abs(fused(-third, v_later, later))) > most)


@in_place
def advance_lanes(runs, c, work, enough):
    """Advance runs (STATES, 8) with constants (CONSTANTS, 8) until `enough` have an unproved step.

    Returns the number of steps.
    """
    x1, x2, v1, v2 = load(runs, X1), load(runs, X2), load(runs, V1), load(runs, V2)
    y1, y2, u1, u2 = load(runs, Y1), load(runs, Y2), load(runs, U1), load(runs, U2)
    s, k, limit, passed = load(runs, SINE), load(runs, COSINE), load(runs, LIMIT), load(runs, PASSED)
    step, third, reach = load(c, STEP), load(c, STEP) * (1 / 3), load(runs, REACH)
    alive, watched = load(runs, ALIVE) > 0.0, load(runs, WATCHED) > 0.0
    ready = (load(runs, TRIAL) == step) & (load(runs, DUE) < 0.0)
    most1 = where(watched, load(runs, STATISTICS_AT + LARGEST), math.inf)
    most2 = where(watched, load(runs, STATISTICS_AT + LARGEST + 1), math.inf)
    square = step * step
    less = fused(load(c, BEND), square * square, load(c, ROUNDING)) * (load(c, DRIVE) * step)
    ca, sa = load(c, CA), load(c, SA)
    w1, w2, r1, r2 = x1 - fused(passed, u1, y1), x2 - fused(passed, u2, y2), v1 - u1, v2 - u2
    steps = 0
    while True:
        a1, a2 = x1 + _change(c, 0, x1, x2, v1, v2, s, k), x2 + _change(c, 1, x1, x2, v1, v2, s, k)
        b1, b2 = v1 + _change(c, 2, x1, x2, v1, v2, s, k), v2 + _change(c, 3, x1, x2, v1, v2, s, k)
        later = passed + step
        q1, q2 = a1 - fused(later, u1, y1), a2 - fused(later, u2, y2)
        o1, o2 = b1 - u1, b2 - u2
        ok = ready & (later <= reach) & (abs(q1) <= limit) & (abs(q2) <= limit)
        ok = ok & _inside(limit, w1, r1, q1, o1, third) & _inside(limit, w2, r2, q2, o2, third)
        if count(alive & ~ok) >= enough:
            break
        wrong, s_later, k_later = 1.0 - limit, s + fused(k, sa, s * ca), k + fused(k, ca, -s * sa)
        turns1 = ok & _may_turn_beyond(most1 - wrong, x1, v1, a1, b1, third)
        turns2 = ok & _may_turn_beyond(most2 - wrong, x2, v2, a2, b2, third)
        if count(turns1 | turns2) > 0:
            early, late = (x1, x2, v1, v2, s, k), (a1, a2, b1, b2, s_later, k_later)
            _keep_turns(runs, c, work, (turns1, turns2), wrong, early, late, step)
            most1 = where(watched, load(runs, STATISTICS_AT + LARGEST), math.inf)
            most2 = where(watched, load(runs, STATISTICS_AT + LARGEST + 1), math.inf)
        s, k = where(ok, s_later, s), where(ok, k_later, k)
        x1, x2, v1, v2 = where(ok, a1, x1), where(ok, a2, x2), where(ok, b1, v1), where(ok, b2, v2)
        passed, limit = where(ok, later, passed), where(ok, limit - less, limit)
        w1, w2, r1, r2 = where(ok, q1, w1), where(ok, q2, w2), where(ok, o1, r1), where(ok, o2, r2)
        steps += 1
    moved = passed > load(runs, PASSED)
    store(runs, TOUCH1, where(moved, 0.0, load(runs, TOUCH1)))
    store(runs, TOUCH2, where(moved, 0.0, load(runs, TOUCH2)))
    store(runs, X1, x1)
    store(runs, X2, x2)
    store(runs, V1, v1)
    store(runs, V2, v2)
    store(runs, SINE, s)
    store(runs, COSINE, k)
    store(runs, LIMIT, limit)
    store(runs, PASSED, passed)
    store(runs, OUTCOME, where(alive & ~ok, DONE, NOTHING))
    return steps


@in_place
def step_to_event(runs, c, work, integrals):
    """Advance pending runs over a step, to an impact or to the end of their flight.

    Returns the number of runs that must leave the lanes. work (2 ORDER + 2, 8): workspace for polynomials; integrals:
    number of observed integrals.
    """
    pending, n = load(runs, OUTCOME) == DONE, ORDER + 1
    x1, x2, v1, v2 = load(runs, X1), load(runs, X2), load(runs, V1), load(runs, V2)
    u1, u2, touch1, touch2 = load(runs, U1), load(runs, U2), load(runs, TOUCH1), load(runs, TOUCH2)
    passed, reach, trial, due = load(runs, PASSED), load(runs, REACH), load(runs, TRIAL), load(runs, DUE)
    y1, y2 = fused(passed, u1, load(runs, Y1)), fused(passed, u2, load(runs, Y2))
    step, drive, kappa = load(c, STEP), load(c, DRIVE), load(c, KAPPA)
    leaves = trial < 0.0
    on_wall = (due >= 0.0) & ~leaves
    _expand(c, x1, x2, v1, v2, load(runs, SINE), load(runs, COSINE), work)

    # time at which the first ball meets a wall
    until = _least(_most(trial, 0.0), reach - passed)
    a1 = x1 - fused(step, u1, y1) + _rough_change(c, 0, x1, x2, v1, v2, load(runs, SINE), load(runs, COSINE))
    a2 = x2 - fused(step, u2, y2) + _rough_change(c, 1, x1, x2, v1, v2, load(runs, SINE), load(runs, COSINE))
    wall1, wall2 = where(a1 > 0.0, 1.0, -1.0), where(a2 > 0.0, 1.0, -1.0)
    t1 = where(abs(a1) >= 1.0, _about(work, 0, touch1 == wall1, wall1, y1, u1, step), math.inf)
    t2 = where(abs(a2) >= 1.0, _about(work, n, touch2 == wall2, wall2, y2, u2, step), math.inf)
    one = where(on_wall, due, where(t1 <= t2, 0.0, 1.0)) == 0.0
    wall, soonest = where(one, wall1, wall2), _least(t1, t2)
    ball, rate = where(one, y1, y2), where(one, u1, u2)
    near = where(where(one, touch1, touch2) == wall, 0.0, where(one, x1, x2) - ball - wall)
    t, found = _sharp(work, one, near, where(one, v1, v2) - rate, soonest)
    found = found & (soonest <= step) & (t > 0.0) & (t <= until)
    missed = (soonest <= until) & ~found
    t = where(on_wall, 0.0, where(found, t, until))

    # flight until then, and its proof
    b1, d1 = _at(work, 0, t)
    b2, d2 = _at(work, n, t)
    time = passed + t
    z1, low1 = _drifted(load(runs, Y1), load(runs, Y1_LOW), u1, time)
    z2, low2 = _drifted(load(runs, Y2), load(runs, Y2_LOW), u2, time)
    size, square, third = fused(time, drive, load(runs, SIZE)), t * t, t * (1 / 3)
    rounding = _rounding(c, size, u1, u2)
    limit = 1.0 - fused(fused(load(c, BEND), size, load(c, BEND_FORCE)), square * square, rounding)
    meets = found | on_wall
    meets1, meets2 = meets & one, meets & ~one
    ok = _inside(limit, x1 - y1, v1 - u1, where(meets1, wall1, b1 - z1), d1 - u1, third)
    ok = ok & _inside(limit, x2 - y2, v2 - u2, where(meets2, wall2, b2 - z2), d2 - u2, third)
    ok = (ok & ~missed) | (t == 0.0)
    ok = ok & (meets1 | (abs(b1 - z1) <= 1.0 - rounding)) & (meets2 | (abs(b2 - z2) <= 1.0 - rounding))

    # impact
    wall = where(on_wall, where(where(one, b1 - z1, b2 - z2) > 0.0, 1.0, -1.0), wall)
    before, rate = where(one, d1, d2), where(one, u1, u2)
    approach = before - rate
    gained = fused(load(c, IMPULSE), approach, load(c, REST) * approach)
    heavy, lower = load(c, EPSILON) > 1.0, fused(-load(c, EPSILON), gained, before)
    ball = where(heavy, rate + gained, fused(kappa, approach, lower))
    box = where(heavy, fused(-kappa, approach, ball), lower)
    plain = wall * approach > ROUNDED * (abs(before) + abs(rate))
    plain = plain & (kappa * abs(approach) > ROUNDED * (abs(approach) + abs(box) + abs(ball)))
    e1, e2 = where(meets1, box, d1), where(meets2, box, d2)
    o1, o2 = where(meets1, ball, u1), where(meets2, ball, u2)

    # next flight
    phase, tail = advance_phase(load(runs, PHASE), load(runs, TAIL), load(c, OMEGA), time)
    full, (less, rest) = phase >= TWO_PI, reduced(phase, tail)
    phase, tail, turns = where(full, less, phase), where(full, rest, tail), load(runs, TURNS)
    turns = where(full, turns + 1.0, turns)
    s, k = _sine_and_cosine(phase, tail)
    whole, since = load(runs, STOP) - turns, (phase - load(c, FIRST)) + (tail - load(c, FIRST_TAIL))
    left = (whole * TWO_PI - since + whole * TWO_PI_TAIL) / load(c, OMEGA)
    force1 = load(c, F1) * s - load(c, K11) * b1 - load(c, K12) * b2 - load(c, C11) * e1 - load(c, C12) * e2
    force2 = load(c, F2) * s - load(c, K12) * b1 - load(c, K22) * b2 - load(c, C12) * e1 - load(c, C22) * e2
    push, inward = wall * where(one, force1, force2), -wall * (box - ball)
    soon = 4.0 * inward <= push * (1.0 - kappa) * _least(left, LOOKAHEAD * load(c, UNIT))
    plain = plain & ~(soon & (inward * inward <= 2.0 * push * (LOW + 4.0 * rounding)))

    there = pending & (ok | leaves)
    impact, doubt = there & meets & plain & ~leaves, there & meets & ~plain & ~leaves
    again = pending & ~there & (t > SHORTEST * step)
    stops = there & ~meets & ~leaves & (time >= reach) & (left <= SAME_TIME)
    if integrals > 0:
        hits, early = (impact & one, impact & ~one), (x1, x2, v1, v2, load(runs, SINE), load(runs, COSINE))
        flight = there, t, time, 1.0 - limit
        _observe(runs, c, work, integrals, flight, hits, early, ((b1, b2), (d1, d2), (e1, e2), (u1, u2), (s, k)))
    e1, e2, o1, o2 = where(doubt, d1, e1), where(doubt, d2, e2), where(doubt, u1, o1), where(doubt, u2, o2)
    put = where(one, b1, b2) - wall
    z1, z2 = where(impact & one, put, z1), where(impact & ~one, put, z2)
    across, energy = b1 - b2, fused(b1, b1, load(c, GROUND) * (b2 * b2))
    size = math.sqrt(fused(e1, e1, e2 * e2) + fused(-load(c, K12), across * across, energy))
    ahead_of_it, square = fused(drive, step, size), step * step
    bend = fused(load(c, BEND), ahead_of_it, load(c, BEND_FORCE))
    limit = 1.0 - fused(bend, square * square, _rounding(c, ahead_of_it, o1, o2))
    _replace(runs, there, X1, b1)
    _replace(runs, there, X2, b2)
    _replace(runs, there, V1, e1)
    _replace(runs, there, V2, e2)
    _replace(runs, there, Y1, z1)
    _replace(runs, there, Y2, z2)
    _replace(runs, there, Y1_LOW, where(impact & one, 0.0, low1))
    _replace(runs, there, Y2_LOW, where(impact & ~one, 0.0, low2))
    _replace(runs, there, U1, o1)
    _replace(runs, there, U2, o2)
    _replace(runs, there, SINE, s)
    _replace(runs, there, COSINE, k)
    _replace(runs, there, PASSED, 0.0)
    _replace(runs, there, REACH, _least(left, LONGEST / load(c, OMEGA)))
    _replace(runs, pending, TRIAL, where(there, step, where(again, 0.5 * t, -1.0)))
    _replace(runs, there, SIZE, size)
    _replace(runs, there, LIMIT, limit)
    _replace(runs, there & (t > 0.0), TOUCH1, 0.0)
    _replace(runs, there & (t > 0.0), TOUCH2, 0.0)
    _replace(runs, impact & one, TOUCH1, wall)
    _replace(runs, impact & ~one, TOUCH2, wall)
    _replace(runs, there, DUE, where(doubt, where(one, 0.0, 1.0), where(leaves, due, -1.0)))
    _replace(runs, there, PHASE, phase)
    _replace(runs, there, TAIL, tail)
    _replace(runs, there, TURNS, turns)
    _replace(runs, impact, EVENTS, load(runs, EVENTS) + 1.0)
    _replace(runs, there & (time > 0.0), STALLED, 0.0)
    out = doubt | (there & leaves)
    store(runs, OUTCOME, where(out, DOUBTFUL, where(stops, STOPPED, NOTHING)))
    return count(out | stops)


@inlined
def _replace(runs, mask, row, value):
    store(runs, row, where(mask, value, load(runs, row)))


@inlined
def _drifted(y, low, u, time):
    """Return the position of a ball after a time as a pair of floats, since equal flights round in the same way."""
    way = fused(time, u, low)
    there = y + way
    part = there - y
    return there, (y - (there - part)) + (way - part)


@inlined
def _rounding(c, size, u1, u2):
    """Return a bound on the rounding of the gaps of a flight."""
    return fused(load(c, ROUNDING), size, load(c, LEAST_ROUNDING)) + ROUNDED * (abs(u1) + abs(u2))


@inlined
def _expand(c, x1, x2, v1, v2, s, k, work):
    """Write the Taylor coefficients of both boxes, orders 0 to ORDER each."""
    n, omega = ORDER + 1, load(c, OMEGA)
    store(work, 0, x1)
    store(work, 1, v1)
    store(work, n, x2)
    store(work, n + 1, v2)
    f1, f2, g1, g2 = load(c, F1) * s, load(c, F2) * s, load(c, F1) * (omega * k), load(c, F2) * (omega * k)
    k11, k12, k22, fall = -load(c, K11), -load(c, K12), -load(c, K22), -(omega * omega)
    c11, c12, c22 = load(c, C11), load(c, C12), load(c, C22)
    for m in range(2, n):
        over = 1.0 / (m * (m - 1.0))
        a1 = fused(1.0 - m, fused(c11, v1, c12 * v2), fused(k11, x1, fused(k12, x2, f1)))
        a2 = fused(1.0 - m, fused(c12, v1, c22 * v2), fused(k12, x1, fused(k22, x2, f2)))
        x1, x2, v1, v2 = v1, v2, a1 * over, a2 * over
        f1, f2, g1, g2 = g1, g2, f1 * (fall * over), f2 * (fall * over)
        store(work, m, v1)
        store(work, n + m, v2)


@inlined
def _at(work, first, t):
    """Return a polynomial and its derivative at t."""
    value, slope = load(work, first + ORDER), 0.0 * t
    for m in range(ORDER - 1, -1, -1):
        slope = fused(slope, t, value)
        value = fused(value, t, load(work, first + m))
    return value, slope


@inlined
def _about(work, first, leaves, wall, y, u, step):
    """Return the approximate time at which a ball meets a wall: a quadratic and two Newton steps.

    leaves: True if the ball is on the wall.
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
def _sharp(work, one, near, speed, t):
    """Return (the zero of a relative position by two Newton steps from t, True if they converge).

    one: of module 1; near, speed: the first two coefficients of the position. The first step uses fewer terms, since
    the second corrects it.
    """
    t = t - _newton_step(work, one, near, speed, t, TERMS + 2)
    change = _newton_step(work, one, near, speed, t, ORDER)
    t = t - change
    return t, abs(change) <= CONVERGING * t


@inlined
def _newton_step(work, one, near, speed, t, order):
    """Return the Newton step at t, with the terms up to an order."""
    n = ORDER + 1
    value, slope = where(one, load(work, order), load(work, n + order)), 0.0 * t
    for m in range(order - 1, 1, -1):
        slope = fused(slope, t, value)
        value = fused(value, t, where(one, load(work, m), load(work, n + m)))
    slope = fused(slope, t, value)
    value = fused(value, t, speed)
    slope = fused(slope, t, value)
    value = fused(value, t, near)
    return value / slope


@inlined
def _sine_and_cosine(phase, tail):
    """Return `phase.sine_and_cosine` in each lane."""
    quarters = math.floor(phase * (1.0 / QUARTER) + 0.5)
    x, y = fused(-quarters, QUARTER, phase), tail - quarters * QUARTER_TAIL
    sine, cosine = sine_and_cosine_near(x, y)
    odd = (quarters == 1.0) | (quarters == 3.0)
    sine, cosine = where(odd, cosine, sine), where(odd, -sine, cosine)
    half = (quarters == 2.0) | (quarters == 3.0)
    return where(half, -sine, sine), where(half, -cosine, cosine)


@inlined
def _observe(runs, c, work, integrals, flight, hits, early, arrival):
    """Add the statistics of a flight and its impact.

    flight: mask of the lanes with a flight, its last step, its time, and the error of Hermite's polynomial in that
    step. hits: mask of the lanes with an impact, per module. early: boxes and forcing before the step. arrival:
    positions of the boxes after it, their velocities before and after the impact, those of the balls, and the forcing.
    """
    (there, t, time, wrong), (boxes, late, after, balls, forcing) = flight, arrival
    watched, third = (load(runs, WATCHED) > 0.0) & there, t * (1 / 3)
    for i in range(2):
        hit, row, approach = watched & hits[i], STATISTICS_AT + LARGEST + i, late[i] - balls[i]
        _add(runs, hit, IMPACTS + i, 1.0)
        _add(runs, hit, LOST + i, load(c, LOSS) * (approach * approach))
        _add(runs, watched, PATH + i, abs(balls[i]) * time)
        _replace(runs, watched, row, _most(abs(boxes[i]), load(runs, row)))
    most = load(runs, STATISTICS_AT + LARGEST), load(runs, STATISTICS_AT + LARGEST + 1)
    turns1 = watched & _may_turn_beyond(most[0] - wrong, early[0], early[2], boxes[0], late[0], third)
    turns2 = watched & _may_turn_beyond(most[1] - wrong, early[1], early[3], boxes[1], late[1], third)
    if count(turns1 | turns2) > 0:
        _keep_turns(runs, c, work, (turns1, turns2), wrong, early, (*boxes, *late, *forcing), t)
    z = 2.0 * boxes[0], 2.0 * boxes[1], late[0] + after[0], late[1] + after[1], 2.0 * forcing[0], 2.0 * forcing[1]
    change = where(hits[0], late[0] - after[0], where(hits[1], late[1] - after[1], 0.0))
    for k in range(integrals):
        place, drop = DROPS + 12 * k, 0.0 * t
        for m in range(6):
            drop = fused(where(hits[0], load(c, place + m), load(c, place + 6 + m)), z[m], drop)
        _add(runs, watched, INTEGRALS + k, fused(change, drop, load(c, DRIFTS + k) * time))


@inlined
def _add(runs, mask, place, value):
    row = STATISTICS_AT + place
    store(runs, row, load(runs, row) + where(mask, value, 0.0))


@inlined
def _keep_turns(runs, c, work, turns, wrong, early, late, step):
    """Store turns of boxes in a step that may be their largest displacements.

    A stored turn is computed first if the larger of both is not certain.

    early, late: boxes and forcing before and after the step. wrong: five times the error of Hermite's polynomial, whose
    hull is close to it if the polynomial is split at the turn.
    """
    wrong = 0.2 * wrong
    for i in range(2):
        x, v, y, w, row = early[i], early[2 + i], late[i], late[2 + i], TURNS_AT + TURN * i
        part, p, q = v / (v - w), fused(step * (1 / 3), v, x), fused(step * (-1 / 3), w, y)
        first, middle, last = fused(part, p - x, x), fused(part, q - p, p), fused(part, y - q, q)
        before, after = fused(part, middle - first, first), fused(part, last - middle, middle)
        ends, corners = _most(abs(x), abs(y)), _most(abs(first), abs(last))
        highest = _most(_most(ends, corners), _most(abs(before), abs(after))) + wrong
        turned = turns[i] & (highest > load(runs, STATISTICS_AT + LARGEST + i))
        if count(turned) == 0:
            continue
        lowest = abs(fused(part, after - before, before)) - wrong
        if count(turned & (load(runs, row + KEPT) > 0.0) & (load(runs, row + HIGHEST) > lowest)) > 0:
            find_turns(runs, c, work)
        is_late, record = part > 0.5, load(runs, STATISTICS_AT + LARGEST + i)
        for k in range(6):
            _replace(runs, turned, row + k, where(is_late, late[k], early[k]))
        _replace(runs, turned, row + SINCE, step * where(is_late, part - 1.0, part))
        _replace(runs, turned, row + HIGHEST, highest)
        _replace(runs, turned, row + KEPT, 1.0)
        _replace(runs, turned, STATISTICS_AT + LARGEST + i, _most(record, lowest))


@in_place
def find_turns(runs, c, work):
    """Compute the stored turns by Newton's method and a final parabola; update the largest displacements.

    The first terms of the polynomials suffice for the time of a turn.
    """
    for i in range(2):
        row, first = TURNS_AT + TURN * i, (ORDER + 1) * i
        kept = load(runs, row + KEPT) > 0.0
        if count(kept) > 0:
            x1, x2, v1, v2 = load(runs, row), load(runs, row + 1), load(runs, row + 2), load(runs, row + 3)
            _expand(c, x1, x2, v1, v2, load(runs, row + 4), load(runs, row + 5), work)
            t = load(runs, row + SINCE)
            for _ in range(2):
                later = t - _slope(work, first, t) / _bend(work, first, t)
                t = where(abs(later) <= load(c, STEP), later, t)
            value, slope = _at(work, first, t)
            turned = abs(value - 0.5 * slope * slope / _bend(work, first, t))
            record = load(runs, STATISTICS_AT + LARGEST + i)
            _replace(runs, kept & (turned > record), STATISTICS_AT + LARGEST + i, turned)
            store(runs, row + KEPT, 0.0)


@inlined
def _slope(work, first, t):
    """Return the derivative of a polynomial at t, from its first terms."""
    total = 0.0 * t
    for m in range(TERMS, 0, -1):
        total = fused(total, t, m * load(work, first + m))
    return total


@inlined
def _bend(work, first, t):
    """Return the second derivative of a polynomial at t, from its first terms."""
    total = 0.0 * t
    for m in range(TERMS, 1, -1):
        total = fused(total, t, m * (m - 1.0) * load(work, first + m))
    return total
