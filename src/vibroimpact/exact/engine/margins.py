"""How far a run is from having had other events: the distances at which each of them would not have happened, or
another would have. A distance is told in units of the error of the state that would bridge it.
"""

import math

import numpy as np

from vibroimpact.exact.engine.compiled import compiled, inlined, unfolded
from vibroimpact.exact.engine.constraints import gap_rounding
from vibroimpact.exact.engine.contact import box_accelerations
from vibroimpact.exact.engine.event_log import PHASE
from vibroimpact.exact.engine.flow import acceleration, inverse_masses
from vibroimpact.exact.engine.motion import mode_of
from vibroimpact.exact.engine.replay import completes_chatter, end_of, start_of
from vibroimpact.exact.engine.turning_points import FORCE, GAP
from vibroimpact.system.state import IMPACT, RELEASE

DEPTH, DOUBT = 0, 1


@compiled
def hits_of(q, flights, events):
    """For each event (m, 2): of an impact the depth that it cut off, u^2 / (2 b) for a speed u and a braking b (inf
    where nothing brakes), and whether that depth is within rounding; else inf and 0.
    """
    hits = np.empty((len(events), 2))
    for n in range(len(events)):
        hits[n, DEPTH], hits[n, DOUBT] = math.inf, 0.0
        if events[n, 3] != IMPACT:
            continue
        i, wall = int(events[n, 1]) - 1, events[n, 2]
        _, _, walls = start_of(flights[n])
        boxes, balls = end_of(flights[n])
        brake = -wall * box_accelerations(q, walls, boxes, math.sin(events[n, PHASE]))[i]
        if brake > 0.0:
            hits[n, DEPTH] = (boxes[2 + i] - balls[2 + i]) ** 2 / (2.0 * brake)
            hits[n, DOUBT] = hits[n, DEPTH] <= gap_rounding(q, boxes, balls, i)
    return hits


@compiled
def margins_of(q, flights, turns, hits, events, start_phase, duration):
    """For each flight the least margin, in units of the error at its start and of that at its end: rows (m + 1, 2).

    At the start of the run a ball must be on a wall or off it, and its motion must say whether it stays. A flight must
    keep its turns (turning_points), and its event its depth (hits_of) and its distance from the end of the run. An
    impact must leave no doubt whether it releases the other ball. At the end no event may be about to happen.
    """
    margins = np.full((len(flights), 2), math.inf)
    for n in range(len(flights)):
        boxes, balls, walls = start_of(flights[n])
        for i in range(2):
            if walls[i] != 0:
                _lower(margins[n], turns[n, FORCE] / _force_weight(q, walls, i))
        _lower(margins[n], turns[n, GAP])
        if n == 0:
            margins[n, 0] = min(margins[n, 0], _at_start(q, boxes, balls, start_phase))
        elif events[n - 1, 3] == IMPACT:
            other = 2 - int(events[n - 1, 1])
            if walls[other] != 0:
                margins[n, 0] = min(margins[n, 0], abs(_force(q, walls, boxes, events[n - 1, PHASE], other)))
        boxes, balls = end_of(flights[n])
        if n < len(events):
            margin = min(hits[n, DEPTH], _of_event(q, walls, boxes, balls, events, n, duration - events[n, 0]))
        else:
            margin = _at_end(q, walls, boxes, balls, start_phase)
        margins[n, 1] = min(margins[n, 1], margin)
    return margins


@inlined
def _lower(margins, margin):
    """Lower the margins of a flight, (2,), to one that counts at its start and at its end."""
    for k in range(2):
        margins[k] = np.minimum(margins[k], margin)


@unfolded
def _of_event(q, walls, boxes, balls, events, n, left):
    """By how much error an event misses the end of the run, a time left after it; of a release, its depth as well."""
    i, wall, kind, phase = int(events[n, 1]) - 1, events[n, 2], events[n, 3], events[n, PHASE]
    force = wall * box_accelerations(q, walls, boxes, math.sin(phase))[i]
    if kind == IMPACT:  # by then the ball would be so far beyond the wall
        return left * (wall * (boxes[2 + i] - balls[2 + i]) + 0.5 * left * max(force, 0.0))
    if kind == RELEASE:
        change, bend = _changes(q, walls, boxes, phase, i)
        depth = 0.5 * change * change / (wall * bend) if wall * bend > 0.0 else math.inf
        return min(left * abs(change), depth) / _force_weight(q, walls, i)
    if completes_chatter(events, n):  # it ends after 2 u / (a (1 - kappa))
        return 0.5 * left * force * (1.0 - q.kappa)
    return math.inf


@unfolded
def _at_start(q, boxes, balls, phase):
    """By how much error the balls are on their walls or off them, and those at rest there held or not."""
    margin = math.inf
    for i in range(2):
        gap, speed = 1.0 - abs(boxes[i] - balls[i]), abs(boxes[2 + i] - balls[2 + i])
        if gap == 0.0 and speed == 0.0:
            margin = min(margin, abs(_force(q, (0, 0), boxes, phase, i)))
        else:
            margin = min(margin, max(gap, speed))
    return margin


@unfolded
def _at_end(q, walls, boxes, balls, phase):
    """By how much error the next event misses the end: of a ball on its way to a wall, or of one that is held less and
    less.
    """
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
    """Acceleration of box i in units of what a unit error makes of it."""
    return box_accelerations(q, walls, boxes, math.sin(phase))[i] / _force_weight(q, walls, i)


@inlined
def _force_weight(q, walls, i):
    """What a unit error of the boxes does to the acceleration of box i."""
    one, two = inverse_masses(q, mode_of(walls))
    if i == 0:
        return one * math.sqrt(q.k11 * q.k11 + q.k12 * q.k12 + q.c11 * q.c11 + q.c12 * q.c12)
    return two * math.sqrt(q.k22 * q.k22 + q.k12 * q.k12 + q.c22 * q.c22 + q.c12 * q.c12)


@inlined
def _changes(q, walls, boxes, phase, i):
    """First and second rate of change of the acceleration of box i."""
    one, two = inverse_masses(q, mode_of(walls))
    s, c, fall = math.sin(phase), q.omega * math.cos(phase), -q.omega * q.omega
    x1, x2, v1, v2 = boxes
    a1, a2 = acceleration(q, one, two, x1, x2, v1, v2, q.f1 * s, q.f2 * s)
    b1, b2 = acceleration(q, one, two, v1, v2, a1, a2, q.f1 * c, q.f2 * c)
    c1, c2 = acceleration(q, one, two, a1, a2, b1, b2, q.f1 * fall * s, q.f2 * fall * s)
    return (b1, c1) if i == 0 else (b2, c2)
