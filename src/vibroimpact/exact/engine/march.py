"""Prototype."""

import math

import numpy as np

from vibroimpact.exact.engine.compiled import compiled, inlined, unfolded, in_place
from vibroimpact.exact.engine.lanes import count, load, store, where, WIDTH, some
from vibroimpact.exact.engine.phase import TWO_PI, TWO_PI_TAIL, QUARTER, QUARTER_TAIL, ahead, fused, reduced, sine_and_cosine_near

(X1, X2, V1, V2, Y1, Y2, U1, U2, SINE, COSINE, LIMIT, PASSED, REACH, TOUCH1, TOUCH2, TRIAL, DUE, PHASE, TAIL, TURNS,
 SIZE, ALIVE, STOP, OUTCOME, EVENTS, LARGEST1, LARGEST2, WATCHED, HITS1, HITS2, PATH1, PATH2, SQUARE1, SQUARE2, STATES) = range(35)
P = 0
(CA, SA, STEP, K11, K12, K22, C11, C12, C22, F1, F2, OMEGA, EPSILON, KAPPA, IMPULSE, REST, GROUND, DRIVE, BEND, BEND0,
 ROUND, ROUND0, FIRST, FIRST_TAIL, UNIT, INVERSE, DRIFT1, DRIFT2) = range(24, 52)
POTENTIAL = 52  # 2 x 2 x 6
CONSTANTS = POTENTIAL + 24
ORDER = 14
NONE, DONE, STOPPED, DOUBT = 0.0, 1.0, 2.0, 3.0
EPS = 4.0 * 2.0**-52
LOW = 1e-12
LONGEST = 6.0
CONV = 1e-8


@inlined
def least(a, b):
    return where(a < b, a, b)


@inlined
def most(a, b):
    return where(a > b, a, b)


@inlined
def row(c, k, x1, x2, v1, v2, s, k_):
    t = fused(load(c, k + 5), k_, load(c, k + 4) * s)
    u = fused(load(c, k + 3), v2, load(c, k + 2) * v1)
    w = fused(load(c, k + 1), x2, load(c, k) * x1)
    return w + (u + t)


@inlined
def inside(limit, w, rate, w1, rate1, third):
    """Return True where the relative position stays within the walls by the hull."""
    return (abs(fused(third, rate, w)) <= limit) & (abs(fused(-third, rate1, w1)) <= limit)


@in_place
def march(runs, c, enough):
    """Carry all lanes on until so many are pending."""
    x1, x2, v1, v2 = load(runs, X1), load(runs, X2), load(runs, V1), load(runs, V2)
    y1, y2, u1, u2 = load(runs, Y1), load(runs, Y2), load(runs, U1), load(runs, U2)
    s, k = load(runs, SINE), load(runs, COSINE)
    limit, passed, reach = load(runs, LIMIT), load(runs, PASSED), load(runs, REACH)
    large1, large2 = load(runs, LARGEST1), load(runs, LARGEST2)
    alive = load(runs, ALIVE) > 0.0
    ready = (load(runs, TRIAL) == load(c, STEP)) & (load(runs, DUE) < 0.0)
    step, third = load(c, STEP), load(c, STEP) * (1 / 3)
    less = (load(c, BEND) * ((step * step) * (step * step)) + load(c, ROUND)) * load(c, DRIVE) * step
    w1, w2, r1, r2 = x1 - y1, x2 - y2, v1 - u1, v2 - u2
    steps = 0
    while True:
        a1, a2 = row(c, 0, x1, x2, v1, v2, s, k), row(c, 6, x1, x2, v1, v2, s, k)
        b1, b2 = row(c, 12, x1, x2, v1, v2, s, k), row(c, 18, x1, x2, v1, v2, s, k)
        z1, z2 = fused(step, u1, y1), fused(step, u2, y2)
        q1, q2, o1, o2 = a1 - z1, a2 - z2, b1 - u1, b2 - u2
        later = passed + step
        ok = ready & (later <= reach) & (abs(q1) <= 1.0 - 1e-13) & (abs(q2) <= 1.0 - 1e-13)
        ok = ok & inside(limit, w1, r1, q1, o1, third) & inside(limit, w2, r2, q2, o2, third)
        turns1 = (v1 * b1 <= 0.0) & (most(abs(fused(third, v1, x1)), abs(fused(-third, b1, a1))) >= large1)
        turns2 = (v2 * b2 <= 0.0) & (most(abs(fused(third, v2, x2)), abs(fused(-third, b2, a2))) >= large2)
        ok = ok & ~(turns1 | turns2)
        if count(alive & ~ok) >= enough:
            break
        ca, sa = load(c, CA), load(c, SA)
        s, k = where(ok, fused(k, sa, s * ca), s), where(ok, fused(k, ca, -s * sa), k)
        x1, x2, v1, v2 = where(ok, a1, x1), where(ok, a2, x2), where(ok, b1, v1), where(ok, b2, v2)
        y1, y2 = where(ok, z1, y1), where(ok, z2, y2)
        w1, w2, r1, r2 = where(ok, q1, w1), where(ok, q2, w2), where(ok, o1, r1), where(ok, o2, r2)
        passed, limit = where(ok, later, passed), where(ok, limit - less, limit)
        steps += 1
    store(runs, X1, x1)
    store(runs, X2, x2)
    store(runs, V1, v1)
    store(runs, V2, v2)
    store(runs, Y1, y1)
    store(runs, Y2, y2)
    store(runs, SINE, s)
    store(runs, COSINE, k)
    moved = passed > load(runs, PASSED)
    store(runs, LIMIT, limit)
    store(runs, PASSED, passed)
    store(runs, TOUCH1, where(moved, 0.0, load(runs, TOUCH1)))
    store(runs, TOUCH2, where(moved, 0.0, load(runs, TOUCH2)))
    store(runs, OUTCOME, where(alive & ~ok, 1.0, 0.0))
    return steps


@inlined
def expand(c, x1, x2, v1, v2, s, k, work):
    """Write the Taylor coefficients of both boxes, orders 0 to ORDER, in work (2 ORDER + 2, 8)."""
    n = ORDER + 1
    k11, k12, k22, c11, c12, c22 = load(c, K11), load(c, K12), load(c, K22), load(c, C11), load(c, C12), load(c, C22)
    store(work, 0, x1)
    store(work, 1, v1)
    store(work, n, x2)
    store(work, n + 1, v2)
    f1, f2, omega = load(c, F1), load(c, F2), load(c, OMEGA)
    f1s, f2s, fall = f1 * s, f2 * s, -(omega * omega)
    g1s, g2s = f1 * (omega * k), f2 * (omega * k)
    for m in range(2, n):
        over = 1.0 / (m * (m - 1))
        e1 = fused(-k11, x1, fused(-k12, x2, f1s)) - fused(c11, v1, c12 * v2) * (m - 1)
        e2 = fused(-k12, x1, fused(-k22, x2, f2s)) - fused(c12, v1, c22 * v2) * (m - 1)
        x1, x2, v1, v2 = v1, v2, e1 * over, e2 * over
        f1s, f2s, g1s, g2s = g1s, g2s, f1s * (fall * over), f2s * (fall * over)
        store(work, m, v1)
        store(work, n + m, v2)


@inlined
def expand_scaled_check():
    pass


@inlined
def polynomial(work, first, t):
    """Return value and slope at t of the polynomial (ORDER + 1) at a place."""
    value, slope = load(work, first + ORDER), 0.0 * t
    for m in range(ORDER - 1, -1, -1):
        slope = fused(slope, t, value)
        value = fused(value, t, load(work, first + m))
    return value, slope


@inlined
def guess(work, first, touch, w, y, u, until):
    """Return about when a gap closes: start by a quadratic, two steps of Newton's method."""
    c0 = where(touch == w, 0.0, 1.0 - w * (load(work, first) - y))
    c1, c2 = -w * (load(work, first + 1) - u), -w * load(work, first + 2)
    root = c1 * c1 - 4.0 * c0 * c2
    t = where(touch == w, -c1 / c2, 2.0 * c0 / (math.sqrt(where(root > 0.0, root, 0.0)) - c1))
    t = where((t > 0.0) & (t <= until), t, until)
    c3, c4, c5 = -w * load(work, first + 3), -w * load(work, first + 4), -w * load(work, first + 5)
    for _ in range(2):
        value = fused(t, fused(t, fused(t, fused(t, fused(t, c5, c4), c3), c2), c1), c0)
        slope = fused(t, fused(t, fused(t, fused(t, 5.0 * c5, 4.0 * c4), 3.0 * c3), 2.0 * c2), c1)
        t = t - value / slope
    return t


@inlined
def _sine_and_cosine(phase, tail):
    quarters = math.floor(phase * (1.0 / QUARTER) + 0.5)
    x, y = fused(-quarters, QUARTER, phase), tail - quarters * QUARTER_TAIL
    sine, cosine = sine_and_cosine_near(x, y)
    odd = (quarters == 1.0) | (quarters == 3.0)
    sine, cosine = where(odd, cosine, sine), where(odd, -sine, cosine)
    half = (quarters == 2.0) | (quarters == 3.0)
    return where(half, -sine, sine), where(half, -cosine, cosine)


@in_place
def meet(runs, c, work):
    """One pass over pending lanes."""
    pending = load(runs, OUTCOME) == 1.0
    x1, x2, v1, v2 = load(runs, X1), load(runs, X2), load(runs, V1), load(runs, V2)
    y1, y2, u1, u2 = load(runs, Y1), load(runs, Y2), load(runs, U1), load(runs, U2)
    s, k, passed, reach = load(runs, SINE), load(runs, COSINE), load(runs, PASSED), load(runs, REACH)
    touch1, touch2, due, step = load(runs, TOUCH1), load(runs, TOUCH2), load(runs, DUE), load(c, STEP)
    n = ORDER + 1
    expand(c, x1, x2, v1, v2, s, k, work)
    until = least(load(runs, TRIAL), reach - passed)
    # where the balls are at the end of a whole step tells which walls they meet
    a1, a2 = row(c, 0, x1, x2, v1, v2, s, k), row(c, 6, x1, x2, v1, v2, s, k)
    q1, q2 = a1 - fused(step, u1, y1), a2 - fused(step, u2, y2)
    side1, side2 = where(q1 > 0.0, 1.0, -1.0), where(q2 > 0.0, 1.0, -1.0)
    t1 = guess(work, 0, touch1, side1, y1, u1, step)
    t2 = guess(work, n, touch2, side2, y2, u2, step)
    t1, t2 = where(abs(q1) >= 1.0, t1, math.inf), where(abs(q2) >= 1.0, t2, math.inf)
    one = where(due >= 0.0, due, where(t1 <= t2, 0.0, 1.0)) == 0.0
    t = least(t1, t2)
    found = (t <= until * 1.001) & (t > 0.0)
    t = where(found, t, until)
    side = where(one, side1, side2)
    same = where(one, touch1, touch2) == side
    y, u = where(one, y1, y2), where(one, u1, u2)
    change = t
    for _ in range(2):
        value, slope = load(work, ORDER), 0.0 * t
        value = where(one, value, load(work, n + ORDER))
        for m in range(ORDER - 1, 1, -1):
            slope = fused(slope, t, value)
            value = fused(value, t, where(one, load(work, m), load(work, n + m)))
        slope = fused(slope, t, value)
        value = fused(value, t, where(one, v1, v2) - u)
        slope = fused(slope, t, value)
        value = fused(value, t, where(same, 0.0, where(one, x1, x2) - y - side))
        change = value / slope
        t = where(found, t - change, t)
    found = found & (t <= until) & (t > 0.0) & (abs(change) <= CONV * t)
    failed = (least(t1, t2) <= until) & ~found
    t = where(due >= 0.0, 0.0, where(found, t, until))
    b1, d1 = polynomial(work, 0, t)
    b2, d2 = polynomial(work, n, t)
    z1, z2 = fused(t, u1, y1), fused(t, u2, y2)
    size = load(runs, SIZE) + (passed + t) * load(c, DRIVE)
    square = t * t
    small = load(c, ROUND0) + load(c, ROUND) * size + EPS * (abs(u1) + abs(u2))
    limit = 1.0 - (load(c, BEND) * size + load(c, BEND0)) * (square * square) - small
    third = t * (1 / 3)
    hit = found | (due >= 0.0)
    hit1, hit2 = hit & one, hit & ~one
    ok = inside(limit, x1 - y1, v1 - u1, where(hit1, side1, b1 - z1), d1 - u1, third)
    ok = ok & inside(limit, x2 - y2, v2 - u2, where(hit2, side2, b2 - z2), d2 - u2, third)
    ok = ok | (due >= 0.0)
    ok = ok & (hit1 | (abs(b1 - z1) <= 1.0 - small)) & (hit2 | (abs(b2 - z2) <= 1.0 - small)) & ~failed

    # the impact
    side = where(due >= 0.0, where(where(one, b1 - z1, b2 - z2) > 0.0, 1.0, -1.0), side)
    box, ball = where(one, d1, d2), where(one, u1, u2)
    velocity = box - ball
    gained = fused(load(c, IMPULSE), velocity, load(c, REST) * velocity)
    heavy = load(c, EPSILON) > 1.0
    kappa = load(c, KAPPA)
    after = where(heavy, ball + gained - kappa * velocity, box - load(c, EPSILON) * gained)
    back = where(heavy, ball + gained, after + kappa * velocity)
    plain = (side * velocity > EPS * (abs(box) + abs(ball)))
    plain = plain & (kappa * abs(velocity) > EPS * (abs(velocity) + abs(after) + abs(back)))
    e1, e2 = where(hit1, after, d1), where(hit2, after, d2)
    w1, w2 = where(hit1, back, u1), where(hit2, back, u2)
    put = where(one, b1, b2) - side
    z1, z2 = where(hit1, put, z1), where(hit2, put, z2)
    phase, tail, turns = load(runs, PHASE), load(runs, TAIL), load(runs, TURNS)
    phase, tail = ahead(phase, tail, load(c, OMEGA), passed + t)
    full = phase >= TWO_PI
    lower, rest = reduced(phase, tail)
    phase, tail, turns = where(full, lower, phase), where(full, rest, tail), where(full, turns + 1.0, turns)
    s, k = _sine_and_cosine(phase, tail)
    whole = load(runs, STOP) - turns
    left = (whole * TWO_PI - ((phase - load(c, FIRST)) + (tail - load(c, FIRST_TAIL))) + whole * TWO_PI_TAIL) / load(c, OMEGA)
    f1, f2 = load(c, F1), load(c, F2)
    acceleration1 = f1 * s - load(c, K11) * b1 - load(c, K12) * b2 - load(c, C11) * e1 - load(c, C12) * e2
    acceleration2 = f2 * s - load(c, K12) * b1 - load(c, K22) * b2 - load(c, C12) * e1 - load(c, C22) * e2
    push, inward = side * where(one, acceleration1, acceleration2), -side * (after - back)
    soon = 4.0 * inward <= push * (1.0 - kappa) * least(left, 2.5 * load(c, UNIT))
    low = inward * inward <= 2.0 * push * (LOW + 4.0 * small)
    plain = plain & ~(soon & low)

    impact = pending & ok & hit & plain
    doubtful = pending & ok & hit & ~plain
    glides = pending & ok & ~hit
    stops = glides & (passed + t >= reach) & (left < 1e-9 )
    halves = pending & ~ok & (t > step * (1 / 30))
    given_up = pending & ~ok & ~halves
    moved = impact | glides
    there = moved | doubtful

    store(runs, X1, where(there, b1, x1))
    store(runs, X2, where(there, b2, x2))
    store(runs, V1, where(moved, e1, where(doubtful, d1, v1)))
    store(runs, V2, where(moved, e2, where(doubtful, d2, v2)))
    store(runs, Y1, where(moved, z1, where(doubtful, fused(t, u1, y1), y1)))
    store(runs, Y2, where(moved, z2, where(doubtful, fused(t, u2, y2), y2)))
    store(runs, U1, where(moved, w1, u1))
    store(runs, U2, where(moved, w2, u2))
    store(runs, SINE, where(there, s, load(runs, SINE)))
    store(runs, COSINE, where(there, k, load(runs, COSINE)))
    store(runs, PHASE, where(there, phase, load(runs, PHASE)))
    store(runs, TAIL, where(there, tail, load(runs, TAIL)))
    store(runs, TURNS, where(there, turns, load(runs, TURNS)))
    store(runs, PASSED, where(there, 0.0, passed))
    store(runs, REACH, where(there, least(left, LONGEST), reach))
    store(runs, TRIAL, where(there, step, where(halves, 0.5 * t, load(runs, TRIAL))))
    store(runs, DUE, where(moved, -1.0, where(doubtful, where(one, 0.0, 1.0), due)))
    store(runs, TOUCH1, where(impact, where(one, side, 0.0), where(glides, 0.0, touch1)))
    store(runs, TOUCH2, where(impact, where(one, 0.0, side), where(glides, 0.0, touch2)))
    a, b = b1 - b2, b1 * b1 + load(c, GROUND) * (b2 * b2)
    size = where(there, math.sqrt(e1 * e1 + e2 * e2 + b - load(c, K12) * (a * a)), load(runs, SIZE))
    store(runs, SIZE, size)
    size = size + load(c, DRIVE) * step
    small = load(c, ROUND0) + load(c, ROUND) * size + EPS * (abs(w1) + abs(w2))
    quartic = (step * step) * (step * step)
    store(runs, LIMIT, where(there, 1.0 - (load(c, BEND) * size + load(c, BEND0)) * quartic - small, load(runs, LIMIT)))
    store(runs, EVENTS, load(runs, EVENTS) + where(impact, 1.0, 0.0))
    store(runs, OUTCOME, where(given_up | doubtful, DOUBT, where(stops, STOPPED, where(pending, DONE, NONE))))
    return count(given_up | doubtful | stops)
