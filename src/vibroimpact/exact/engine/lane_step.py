"""One impact and the following flight of eight runs at once; steps that are not plain go to the event loop.

A step is plain if both balls fly and one of them is due, its rebound begins no chatter that ends soon, and each proof
finds that both balls keep their direction until the next impact or the end of the proof. Where a proof ends before an
impact, the flight goes on with the next step. The formulas are those of the event loop, operation by operation, so that
a run has the same bits as alone. Where any doubt remains nothing is done.
"""

import math

from vibroimpact.exact.engine.compiled import inlined
from vibroimpact.exact.engine.contact import impact
from vibroimpact.exact.engine.exclusion import CONVERGING, LOOKAHEAD, RESOLUTION, SHORT, gap, gap_rounding, remainder
from vibroimpact.exact.engine.flow import acceleration, along, half_curvature, slope, value
from vibroimpact.exact.engine.lanes import entries, load, some, store, weighted_sums, where
from vibroimpact.exact.engine.phase import (
    QUARTER,
    QUARTER_TAIL,
    TWO_PI,
    TWO_PI_TAIL,
    ahead,
    fused,
    reduced,
    sine_and_cosine_near,
)

NEWTON_STEPS = 3
DUE, PHASE, TAIL, REVOLUTIONS, ELAPSED, STALLED, MID, ROWS = 12, 13, 14, 15, 16, 18, 20, 27
"""Places of a paused run (`event_loop.keep_progress`), here of eight runs side by side; from MID on, of a flight with a
proof behind it: how long it has lasted, boxes, sine and cosine of the phase; the number of places."""
DONE, TIME, WALL, APPROACH, SINE, COSINE, RESIDUAL, STATE, AT, NOTES = 0, 1, 2, 3, 4, 5, 6, 7, 15, 16
"""Rows of the notes of a step: 1 in DONE for an impact and its flight, 2 for a proof alone, 0 for nothing; of the
impact its time, wall (of module 2: twice), relative velocity before it, sine and cosine of the phase, distance from the
wall, state after it and phase; their number."""


@inlined
def step_lanes(flow, runs, first, cycles, notes):
    """Carry eight runs, (ROWS, 8), over their next plain impact and flight, and fill in notes (NOTES, 8).

    first: the phase at the start and its tail.
    """
    q = flow.coefficients
    phase, tail, revolutions, due = load(runs, PHASE), load(runs, TAIL), load(runs, REVOLUTIONS), load(runs, DUE)
    boxes = load(runs, 0), load(runs, 1), load(runs, 2), load(runs, 3)
    balls = load(runs, 4), load(runs, 5), load(runs, 6), load(runs, 7)
    flying = (load(runs, 8) == 0.0) & (load(runs, 9) == 0.0) & (due >= 0.0)
    one = due == 0.0  # module 1 is due, else module 2
    sine, cosine = _sine_and_cosine(phase, tail)
    whole = cycles - revolutions
    ahead_of_start = (phase - first[0]) + (tail - first[1])
    remaining = (whole * TWO_PI - ahead_of_start + whole * TWO_PI_TAIL) / q.omega

    # the impact
    relative = where(one, boxes[0] - balls[0], boxes[1] - balls[1])
    aside = where(one, boxes[1] - balls[1], boxes[0] - balls[0])
    box, ball = where(one, boxes[2], boxes[3]), where(one, balls[2], balls[3])
    wall = where(relative > 0.0, 1.0, -1.0)
    velocity = box - ball
    slow = RESOLUTION * (abs(box) + abs(ball))
    residual = abs(1.0 - wall * relative)
    put = where(one, boxes[0], boxes[1]) - wall
    balls = where(one, put, balls[0]), where(one, balls[1], put), balls[2], balls[3]
    room_before = where(one, gap_rounding(q, boxes, balls, 1), gap_rounding(q, boxes, balls, 0))
    after, back = impact(q, box, ball)
    rebound = after - back
    boxes = boxes[0], boxes[1], where(one, after, boxes[2]), where(one, boxes[3], after)
    balls = balls[0], balls[1], where(one, back, balls[2]), where(one, balls[3], back)
    room_after = where(one, gap_rounding(q, boxes, balls, 1), gap_rounding(q, boxes, balls, 0))
    distance = 1.0 - where(aside > 0.0, 1.0, -1.0) * aside
    hits = (abs(velocity) > slow) & (wall * velocity > 0.0) & (distance > room_before) & (distance > room_after)
    hits = hits & (q.kappa * abs(velocity) > RESOLUTION * (abs(velocity) + abs(after) + abs(back)))
    a1, a2 = acceleration(q, 1.0, 1.0, boxes[0], boxes[1], boxes[2], boxes[3], q.f1 * sine, q.f2 * sine)
    push, inward = wall * where(one, a1, a2), -wall * rebound
    lasting = 4.0 * inward > push * (1.0 - q.kappa) * _least(remaining, LOOKAHEAD * flow.unit)
    ok = flying & (remaining > 0.0) & hits & lasting & ((rebound > 0.0) | (rebound < 0.0))

    # a proof: from the impact, or from where the last proof ended
    short = SHORT * flow.unit
    reach = _least(remaining, flow.longest)
    passed = load(runs, MID)
    halfway = passed > 0.0
    forced = boxes[0], boxes[1], boxes[2], boxes[3], sine, cosine
    now = (
        where(halfway, load(runs, MID + 1), boxes[0]),
        where(halfway, load(runs, MID + 2), boxes[1]),
        where(halfway, load(runs, MID + 3), boxes[2]),
        where(halfway, load(runs, MID + 4), boxes[3]),
        where(halfway, load(runs, MID + 5), sine),
        where(halfway, load(runs, MID + 6), cosine),
    )
    here = balls[0] + passed * balls[2], balls[1] + passed * balls[3], balls[2], balls[3]
    here = where(halfway, here[0], balls[0]), where(halfway, here[1], balls[1]), balls[2], balls[3]
    x1, x2, u1, u2, _, _ = now
    horizon = _least(reach - passed, LOOKAHEAD * flow.unit)
    jets = weighted_sums(flow.series, 0, 0.0 * due, now)
    bound = remainder(q, 0, jets, horizon * q.growth)
    v1, v2 = u1 - balls[2], u2 - balls[3]
    w1, w2 = where(v1 > 0.0, 1.0, -1.0), where(v2 > 0.0, 1.0, -1.0)
    g1, g2 = 1.0 - w1 * (x1 - here[0]), 1.0 - w2 * (x2 - here[1])
    ok = ok & ((v1 > 0.0) | (v1 < 0.0)) & ((v2 > 0.0) | (v2 < 0.0))
    sooner = g1 * abs(v2) <= g2 * abs(v1)
    c1, c2 = gap(jets[0], here[0], here[2], w1), gap(jets[1], here[1], here[3], w2)
    place = x1, x2, u1, u2
    margin1, margin2 = gap_rounding(q, place, here, 0), gap_rounding(q, place, here, 1)
    c, other = _chosen(sooner, c1, c2), _chosen(sooner, c2, c1)
    margin, others = where(sooner, margin1, margin2), where(sooner, margin2, margin1)
    holds, certain, t, width = _crossing(c, bound, margin, horizon, short)
    t, width = where(holds, horizon, t), where(holds, 0.0, width)
    asked = _least(t + width + short, horizon)
    clear, met, later, spread = _crossing(other, bound, others, asked, short)
    ok = ok & (holds | certain) & (clear | met)
    until, safe = where(clear, asked, later - spread), t - width
    first_due = ~holds & (t + width <= until)
    other_due = ~first_due & ~clear & (later + spread <= safe)
    aimed = first_due | other_due
    due_next = where(first_due, where(sooner, 0.0, 1.0), where(sooner, 1.0, 0.0))
    t, width = where(first_due, t, later), where(first_due, width, spread)
    farther = passed + _least(safe, until)
    end = where(aimed, passed + t, farther)
    width = where(aimed, width, 0.0)
    ok = ok & (end + width + short < reach) & (end > passed)

    # the time of the impact, or where the proof ends
    t, low, high = where(ok, end, 0.0), end - width, end + width
    first_module = due_next == 0.0
    j = math.floor(t * flow.density + 0.5)
    jets = weighted_sums(flow.series, 0, j, forced)
    rest = t - j * flow.spacing
    angle = q.omega * rest
    h = angle * angle
    sa = angle * (1.0 - h * (1 / 6) * (1.0 - h * (1 / 20) * (1.0 - h * (1 / 42))))
    ca = 1.0 - h * (1 / 2) * (1.0 - h * (1 / 12) * (1.0 - h * (1 / 30)))
    ta, ts = entries(flow.rotations, j, 0), entries(flow.rotations, j, 1)
    s, c = sine * ta + cosine * ts, cosine * ta - sine * ts
    there = along(jets, rest)
    advanced = ok & ~aimed
    store(runs, MID, where(advanced, t, passed))
    for i in range(4):
        store(runs, MID + 1 + i, where(advanced, there[i], load(runs, MID + 1 + i)))
    store(runs, MID + 5, where(advanced, s * ca + c * sa, load(runs, MID + 5)))
    store(runs, MID + 6, where(advanced, c * ca - s * sa, load(runs, MID + 6)))
    ok = ok & aimed
    found, step = _impact_time(jets, balls, j * flow.spacing, rest, first_module)
    t = j * flow.spacing + step
    ok = ok & found & (low <= t) & (t <= high)
    if some(ok & (abs(step) > short)):
        again = ok & (abs(step) > short)
        j = where(again, math.floor(where(again, t, 0.0) * flow.density + 0.5), j)
        jets = weighted_sums(flow.series, 0, j, forced)
        rest = where(again, t - j * flow.spacing, rest)
        found, step = _impact_time(jets, balls, j * flow.spacing, rest, first_module)
        t = j * flow.spacing + step
        ok = ok & found & (low <= t) & (t <= high)
    ok = ok & (abs(step) <= short) & (t > 0.0)
    ended = along(jets, step)
    carried = balls[0] + t * balls[2], balls[1] + t * balls[3], balls[2], balls[3]
    for i in range(2):
        ok = ok & (abs(ended[i] - carried[i]) - 1.0 <= 16.0 * gap_rounding(q, ended, carried, i))
    turned, rest = ahead(phase, tail, q.omega, t)
    full = turned >= TWO_PI
    less, small = reduced(turned, rest)
    turned, rest, turns = (
        where(full, less, turned),
        where(full, small, rest),
        where(full, revolutions + 1.0, revolutions),
    )
    elapsed = (turns * TWO_PI + ((turned - first[0]) + (rest - first[1]))) / q.omega

    store(notes, DONE, where(ok, 1.0, where(advanced, 2.0, 0.0)))
    store(notes, TIME, load(runs, ELAPSED))
    store(notes, WALL, where(one, wall, 2.0 * wall))
    store(notes, APPROACH, velocity)
    store(notes, SINE, sine)
    store(notes, COSINE, cosine)
    store(notes, RESIDUAL, residual)
    for i in range(4):
        store(notes, STATE + 2 * i, boxes[i])
        store(notes, STATE + 2 * i + 1, balls[i])
        store(runs, i, where(ok, ended[i], load(runs, i)))
        store(runs, 4 + i, where(ok, carried[i], load(runs, 4 + i)))
    store(runs, DUE, where(ok, due_next, due))
    store(runs, MID, where(ok, 0.0, load(runs, MID)))
    store(notes, AT, phase)
    store(runs, PHASE, where(ok, turned, phase))
    store(runs, TAIL, where(ok, rest, tail))
    store(runs, REVOLUTIONS, where(ok, turns, revolutions))
    store(runs, ELAPSED, where(ok, elapsed, load(runs, ELAPSED)))
    store(runs, STALLED, where(ok, 0.0, load(runs, STALLED)))


@inlined
def _impact_time(jets, balls, node, rest, first):
    """Return (True if found, time) of the impact after a node, sought from rest on; first: of module 1, else 2."""
    there1, there2 = balls[0] + node * balls[2], balls[1] + node * balls[3]
    w1, w2 = where(jets[0][0] > there1, 1.0, -1.0), where(jets[1][0] > there2, 1.0, -1.0)
    return _nearby_zero(_chosen(first, gap(jets[0], there1, balls[2], w1), gap(jets[1], there2, balls[3], w2)), rest)


@inlined
def _least(a, b):
    return where(a < b, a, b)


@inlined
def _chosen(mask, a, b):
    """Return one of two polynomials (8,) in each lane."""
    return (
        where(mask, a[0], b[0]),
        where(mask, a[1], b[1]),
        where(mask, a[2], b[2]),
        where(mask, a[3], b[3]),
        where(mask, a[4], b[4]),
        where(mask, a[5], b[5]),
        where(mask, a[6], b[6]),
        where(mask, a[7], b[7]),
    )


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
def _bernstein(c, t):
    """Return `exclusion.least` in each lane."""
    t2 = t * t
    t3, t4 = t2 * t, t2 * t2
    b = (
        c[0],
        c[1] * t * (1 / 7),
        c[2] * t2 * (1 / 21),
        c[3] * t3 * (1 / 35),
        c[4] * t4 * (1 / 35),
        c[5] * (t2 * t3) * (1 / 21),
        c[6] * (t3 * t3) * (1 / 7),
        c[7] * (t3 * t4),
    )
    low = c[0]
    for _ in range(7):
        b = (b[0] + b[1], b[1] + b[2], b[2] + b[3], b[3] + b[4], b[4] + b[5], b[5] + b[6], b[6] + b[7], b[7])
        low = where(low < b[0], low, b[0])
    return low


@inlined
def _crossing(c, remainder, margin, horizon, short):
    """Return `exclusion.crossing` in each lane as (holds up to the horizon, certain, time, width); a short one is not
    certain.
    """
    low = (c[0], c[1], c[2], c[3], c[4], c[5], c[6], -remainder)
    fall = (-c[1], -2.0 * c[2], -3.0 * c[3], -4.0 * c[4], -5.0 * c[5], -6.0 * c[6], -7.0 * remainder, 0.0 * remainder)
    holds = (value(low, horizon) > margin) & (_bernstein(fall, horizon) > 0.0)
    root = c[1] * c[1] - 4.0 * c[0] * c[2]
    t = where(root > 0.0, 2.0 * c[0] / (math.sqrt(where(root > 0.0, root, 0.0)) - c[1]), -c[0] / c[1])
    f, g = value(low, t), slope(low, t)
    t = t - f * g / (g * g - f * half_curvature(low, t))
    size, square = abs(t), t * t
    unsure = abs(value(low, t)) + margin + 2.0 * remainder * (size * square * (square * square))
    until = 1.125 * size - 8.0 * margin / c[1]
    width = unsure / _bernstein(fall, until)
    certain = (size <= until) & (until <= horizon) & (width > 0.0) & (t + width <= until)
    return holds, certain & (size > short) & (width <= 0.5 * t), t, width


@inlined
def _nearby_zero(c, t):
    """Return `exclusion.nearby_zero` in each lane as (True if a few steps find it, the zero)."""
    inverse = 1.0 / c[1]
    near, b, d, e = -c[0] * inverse, c[2] * inverse, c[3] * inverse, c[4] * inverse
    series = near + near * near * (near * ((2.0 * b * b - d) + near * (5.0 * b * (d - b * b) - e)) - b)
    t = where(abs(near * b) < 0.05, series, t)
    done = t > math.inf
    for _ in range(NEWTON_STEPS):
        step = value(c, t) / slope(c, t)
        t = where(done, t, t - step)
        done = done | (abs(step) <= CONVERGING)
    return done, t
