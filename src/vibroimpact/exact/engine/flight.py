"""The flight to the next event, none missed on the way.

From where nothing has happened yet, each module says how far it may certainly fly, or when it certainly has its next
event (constraints.module_time). An event that is certain and the first is sought at once, by Newton's method from the
time of the flow table next to it; else the flight goes on to the end of what is proved.
"""

import math

from vibroimpact.exact.engine.compiled import inlined
from vibroimpact.exact.engine.constraints import LOOKAHEAD, SHORT, gap, module_time, remainder
from vibroimpact.exact.engine.event_log import EVALUATIONS, FLIGHTS, UNDECIDED
from vibroimpact.exact.engine.exclusion import nearby_zero
from vibroimpact.exact.engine.flow import advance, along, jet, node
from vibroimpact.exact.engine.motion import carry, mode_of

TRIES = 3
STUCK_IN_TIME, TIRED = -2, -3


@inlined
def fly(flow, boxes, balls, walls, touching, sine, cosine, remaining, most_proofs, ledger):
    """The flight to the next event, the end of the run or of the table: (time, module due or -1, boxes, balls).

    Gives up where time stands still, or when the ledger counts more than most_proofs.
    """
    q = flow.coefficients
    mode = mode_of(walls)
    reach = min(remaining, flow.longest)
    short = SHORT * flow.unit
    now, there, s, c, t = boxes, balls, sine, cosine, 0.0
    ledger[FLIGHTS] += 1
    while True:
        if t >= reach:
            return t, -1, now, there
        ledger[EVALUATIONS] += 1
        jets = jet(q, mode, now, s, c)
        horizon = min(reach - t, LOOKAHEAD * flow.unit)
        bound = remainder(q, mode, jets, horizon * q.growth)
        due, step, width, safe, doubt = _next(q, mode, now, there, jets, walls, touching, bound, s, c, horizon, short)
        step = step if step >= -t else 0.0  # an event that was just passed is not before the flight
        met, later, end = due >= 0 and abs(step) <= short, now, t + step
        if met:
            ledger[UNDECIDED] += doubt
            later = along(jets, step)
        elif due >= 0 and walls[due] == 0 and end + width + short < reach:
            met, end, later = _aim(flow, mode, boxes, balls, walls, sine, cosine, due, end, end - width, end + width)
        if met:
            return end, due, later, carry(balls, walls, later, end)
        if not t + safe > t:
            return t, STUCK_IN_TIME, now, there
        if ledger[EVALUATIONS] > most_proofs:
            return t, TIRED, now, there
        t = min(t + safe, reach)
        now, s, c = advance(flow, mode, boxes, sine, cosine, t)
        there = carry(balls, walls, now, t)
        touching = (0, 0)


@inlined
def _next(q, mode, boxes, balls, jets, walls, touching, bound, sine, cosine, horizon, short):
    """What comes first: (module or -1, its time, width of that, time before which nothing happens, doubt).

    Module -1: no event is certain to be the first.
    """
    one = _sooner(boxes, balls)
    two = 1 - one
    t1, w1, u1 = module_time(
        q, mode, one, boxes, balls, jets, walls[one], touching[one], bound, sine, cosine, horizon, short
    )
    w, s1 = _bounds(t1, w1, short)
    # the other module is asked a little further, so that it cannot interfere where the first one is due
    asked = min(t1 + w + short, horizon)
    t2, w2, u2 = module_time(
        q, mode, two, boxes, balls, jets, walls[two], touching[two], bound, sine, cosine, asked, short
    )
    v, s2 = _bounds(t2, w2, short)
    if w1 < math.inf and t1 + w <= s2:
        return one, t1, w, s1, u1
    if w2 < math.inf and t2 + v <= s1:
        return two, t2, v, s2, u2
    return -1, 0.0, 0.0, min(s1, s2), False


@inlined
def _bounds(t, width, short):
    """What module_time tells, in other words: how uncertain a time is, and until when nothing happens."""
    w = 0.0 if width == math.inf or abs(t) <= short else width
    return w, t - w


@inlined
def _sooner(boxes, balls):
    """The module whose ball is sooner at the wall ahead at its present speed."""
    v1, v2 = boxes[2] - balls[2], boxes[3] - balls[3]
    g1 = 1.0 - math.copysign(1.0, v1) * (boxes[0] - balls[0])
    g2 = 1.0 - math.copysign(1.0, v2) * (boxes[1] - balls[1])
    return 0 if g1 * abs(v2) <= g2 * abs(v1) else 1


@inlined
def _aim(flow, mode, boxes, balls, walls, sine, cosine, i, t, low, high):
    """The impact of module i that is certain to be alone in [low, high]: (whether found, its time, boxes)."""
    for _ in range(TRIES):
        j = int(t * flow.density + 0.5)
        now, s, c = node(flow, mode, boxes, sine, cosine, j)
        jets = jet(flow.coefficients, mode, now, s, c)
        there = carry(balls, walls, now, j * flow.spacing)
        w = 1.0 if now[i] > there[i] else -1.0
        step = nearby_zero(gap(jets[0] if i == 0 else jets[1], there[i], there[2 + i], w), t - j * flow.spacing)
        t = j * flow.spacing + step
        if not low <= t <= high:
            break
        if abs(step) <= SHORT * flow.unit:
            return True, t, along(jets, step)
    return False, t, boxes
