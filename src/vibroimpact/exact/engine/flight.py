"""The flight to the next event, none missed on the way.

From where nothing has happened yet, each module says how far it may certainly fly, or when it certainly has its next
event (constraints.module_time). An event that is certain and the first is sought at once, by Newton's method from the
time of the flow table next to it; else the flight goes on to the end of what is proved.
"""

import math

from vibroimpact.exact.engine.compiled import inlined, unfolded
from vibroimpact.exact.engine.constraints import LOOKAHEAD, SHORT, gap, module_time, remainder
from vibroimpact.exact.engine.event_log import EVALUATIONS, FLIGHTS, UNDECIDED
from vibroimpact.exact.engine.exclusion import nearby_zero
from vibroimpact.exact.engine.flow import along, jet_at
from vibroimpact.exact.engine.motion import carry, glide, mode_of

TRIES = 3
STUCK_IN_TIME, TIRED = -2, -3


@unfolded
def fly(flow, motion, remaining, most_proofs, ledger):
    """The flight to the next event, the end of the run or of the table: (time, module due or -1, boxes, balls).

    Gives up where time stands still, or when the ledger counts more than most_proofs.
    """
    q = flow.coefficients
    mode = mode_of(motion.walls)
    reach = min(remaining, flow.longest)
    short = SHORT * flow.unit
    now, t = motion, 0.0
    ledger[FLIGHTS] += 1
    while True:
        if t >= reach:
            return t, -1, now.boxes, now.balls
        ledger[EVALUATIONS] += 1
        jets = jet_at(flow, mode, now.boxes, now.sine, now.cosine, 0)
        horizon = min(reach - t, LOOKAHEAD * flow.unit)
        bound = remainder(q, mode, jets, horizon * q.growth)
        due, step, width, safe, doubt = _next(q, now, jets, bound, horizon, short)
        step = step if step >= -t else 0.0  # an event that was just passed is not before the flight
        met, boxes, end = due >= 0 and abs(step) <= short, now.boxes, t + step
        if met:
            ledger[UNDECIDED] += doubt
            boxes = along(jets, step)
        elif due >= 0 and now.walls[due] == 0 and end + width + short < reach:
            met, end, boxes = _aim(flow, motion, due, end, end - width, end + width)
        if met:
            return end, due, boxes, carry(motion.balls, motion.walls, boxes, end)
        if not t + safe > t:
            return t, STUCK_IN_TIME, now.boxes, now.balls
        if ledger[EVALUATIONS] > most_proofs:
            return t, TIRED, now.boxes, now.balls
        t = min(t + safe, reach)
        now = glide(flow, motion, t)


@unfolded
def _next(q, motion, jets, bound, horizon, short):
    """What comes first: (module or -1, its time, width of that, time before which nothing happens, doubt).

    Module -1: no event is certain to be the first.
    """
    one = _sooner(motion.boxes, motion.balls)
    two = 1 - one
    t1, w1, u1 = module_time(q, motion, one, jets, bound, horizon, short)
    w, s1 = _bounds(t1, w1, short)
    # the other module is asked a little further, so that it cannot interfere where the first one is due
    t2, w2, u2 = module_time(q, motion, two, jets, bound, min(t1 + w + short, horizon), short)
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


@unfolded
def _sooner(boxes, balls):
    """The module whose ball is sooner at the wall ahead at its present speed."""
    v1, v2 = boxes[2] - balls[2], boxes[3] - balls[3]
    g1 = 1.0 - math.copysign(1.0, v1) * (boxes[0] - balls[0])
    g2 = 1.0 - math.copysign(1.0, v2) * (boxes[1] - balls[1])
    return 0 if g1 * abs(v2) <= g2 * abs(v1) else 1


@inlined
def _aim(flow, motion, i, t, low, high):
    """The impact of module i that is certain to be alone in [low, high]: (whether found, its time, boxes)."""
    mode = mode_of(motion.walls)
    for _ in range(TRIES):
        j = int(t * flow.density + 0.5)
        jets = jet_at(flow, mode, motion.boxes, motion.sine, motion.cosine, j)
        now = jets[0][0], jets[1][0], jets[0][1], jets[1][1]
        there = carry(motion.balls, motion.walls, now, j * flow.spacing)
        w = 1.0 if now[i] > there[i] else -1.0
        step = nearby_zero(gap(jets[0] if i == 0 else jets[1], there[i], there[2 + i], w), t - j * flow.spacing)
        t = j * flow.spacing + step
        if not low <= t <= high:
            break
        if abs(step) <= SHORT * flow.unit:
            return True, t, along(jets, step)
    return False, t, motion.boxes
