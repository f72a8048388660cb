"""The event-driven integration of (10.2): flights, impacts, chatter, sticking and release.

Between events the flow is linear and evaluated in closed form (flow.advance). The next event is approached from the
safe side (constraints.module_time), so nothing before it is missed. Events:

impact    a ball meets a wall with outward relative velocity: Newton's restitution, momentum conserved;
stick     the end of a chatter: infinitely many impacts in a finite time, completed at once when what that neglects is
          below rounding; from then on box and ball move as one of mass 1 + epsilon;
release   the contact force of a sticking ball falls to zero, or an impact in the other module makes it jump below zero.

Time is the forcing phase, kept modulo one period with a compensation term, so it does not lose digits in long runs.
Boxes are tuples (X1, X2, X1', X2'), balls (Y1, Y2, Y1', Y2'), walls the wall that each ball sticks to, or 0.
"""

import math

import numpy as np

from vibroimpact.exact.compiled import compiled
from vibroimpact.exact.constraints import (
    RESOLUTION,
    SHORT,
    acceleration_rounding,
    derivatives,
    fifth_bound,
    gap_rounding,
    module_time,
    wall_time,
)
from vibroimpact.exact.flow import acceleration, advance, inverse_masses
from vibroimpact.system.restitution import after_impact

IMPACT, STICK, RELEASE = 0, 1, 2
FINISHED, PENETRATED, STALLED, CROWDED = 0, 1, 2, 3
FLIGHTS, EVALUATIONS, UNDECIDED, CHATTERS, RESIDUAL, NEGLECTED, CLEARED, PIERCED, CLEARED_BY, PIERCED_AT = range(10)
"""Entries of a run's ledger: four counts, then the largest |W| - 1 at an impact, the sum of what completed chatters
neglect, the smallest gap at a turn before a wall, the smallest depth that an impact cut off, and the times by which
and at which these two happened."""

TWO_PI = 2.0 * math.pi
TWO_PI_TAIL = 2.4492935982947064e-16  # 2 pi - float(2 pi)
TURN_STEPS = 4  # the gap is stationary at a turn: half the digits of its time give all of the gap
LOOKAHEAD = 2.0  # in units of the flow
NEGLIGIBLE = 1e-18
MOST_AT_ONCE = 6  # events of one instant: an impact, the end of its chatter and a release in each module
STUCK_IN_TIME = -2
PATIENCE = 100_000  # events without any progress of time after which a run is given up

_impact = compiled(after_impact)


@compiled
def mode_of(walls):
    """Index of the contact state in the flow tables."""
    return (1 if walls[0] != 0 else 0) + (2 if walls[1] != 0 else 0)


@compiled
def _acceleration(q, walls, boxes, sine):
    """Accelerations of both boxes."""
    i1, i2 = inverse_masses(q, mode_of(walls))
    return acceleration(q, i1, i2, boxes[0], boxes[1], boxes[2], boxes[3], q.f1 * sine, q.f2 * sine)


@compiled
def _pair(values, i, value):
    """The pair with its i-th entry replaced."""
    return (value, values[1]) if i == 0 else (values[0], value)


@compiled
def _with_velocity(values, i, velocity):
    """Boxes or balls with the velocity of module i replaced."""
    return (values[0], values[1], velocity, values[3]) if i == 0 else (values[0], values[1], values[2], velocity)


@compiled
def _with_position(values, i, position):
    """Boxes or balls with the position of module i replaced."""
    return (position, values[1], values[2], values[3]) if i == 0 else (values[0], position, values[2], values[3])


@compiled
def carry(balls, walls, boxes, t):
    """Balls a time t after the start of a flight, the boxes being there already."""
    y1, y2, v1, v2 = balls[0] + t * balls[2], balls[1] + t * balls[3], balls[2], balls[3]
    if walls[0] != 0:
        y1, v1 = boxes[0] - walls[0], boxes[2]
    if walls[1] != 0:
        y2, v2 = boxes[1] - walls[1], boxes[3]
    return y1, y2, v1, v2


@compiled
def glide(flow, boxes, balls, walls, sine, cosine, t):
    """Boxes and balls a time t later, no event in between."""
    x1, x2, v1, v2, _, _ = advance(flow, mode_of(walls), boxes[0], boxes[1], boxes[2], boxes[3], sine, cosine, t)
    later = (x1, x2, v1, v2)
    return later, carry(balls, walls, later, t)


@compiled
def pack(boxes, balls, state):
    """Write the state in the public order [X1, Y1, X2, Y2, X1', Y1', X2', Y2']."""
    for i in range(4):
        state[2 * i] = boxes[i]
        state[2 * i + 1] = balls[i]


@compiled
def _record(events, count, time, i, wall, kind, boxes, balls):
    """Write an event to its row of the table; returns the number of events."""
    events[count, 0], events[count, 1], events[count, 2], events[count, 3] = time, i + 1, wall, kind
    for k in range(4):
        events[count, 4 + 2 * k] = boxes[k]
        events[count, 5 + 2 * k] = balls[k]
    return count + 1


@compiled
def _push(q, d, boxes, i, wall, sticking):
    """Sign of the force between ball i and the wall that it is at rest on: > 0 holds it there, < 0 would have to pull.

    Where the force vanishes within rounding its first derivative that does not decides. So it does for a sticking ball
    where the pull is too brief to lift the ball by more than rounding: it would lift it by 2 |force|^3 / (3 change^2).
    """
    tiny = acceleration_rounding(q, boxes)
    force, change = wall * d[i], wall * d[2 + i]
    if abs(force) <= tiny:
        for k in (2, 4, 6):
            if d[k + i] != 0.0:
                return wall * d[k + i]
        return 0.0
    if sticking and force < 0.0 < change and -(force**3) < tiny * change**2:
        return change
    return force


@compiled
def _end_of_chatter(flow, boxes, balls, walls, touching, sine, cosine, remaining, i, ledger):
    """(whether the chatter of ball i may be completed now, time to its end).

    After an impact with inward speed u under the push a the flights shrink by kappa each and end after
    T = 2 u / (a (1 - kappa)). Completing at once keeps the momentum of box and ball; it neglects the force of the
    springs on the distance of the ball meanwhile, of order u^3 / a^2.
    """
    q = flow.coefficients
    mode = mode_of(walls)
    wall = touching[i]
    a = wall * _acceleration(q, walls, boxes, sine)[i]
    u = -wall * (boxes[2 + i] - balls[2 + i])
    if a <= acceleration_rounding(q, boxes):
        return False, 0.0
    total = 2.0 * u / (a * (1.0 - q.kappa))
    window = 2.0 * total
    if window > min(remaining, LOOKAHEAD * flow.unit):
        return False, 0.0
    d = derivatives(q, mode, boxes, sine, cosine)
    j, bound = wall * d[2 + i], fifth_bound(q, mode, d, window)
    change = abs(j) + window * (abs(d[4 + i]) / 2 + window * bound / 6)
    if window * change > 0.25 * a:
        return False, 0.0
    neglected = q.epsilon * (q.k11 + q.k22) * u**3 / (a * a * (1.0 - q.kappa**3))
    unresolved = u * u <= 2.0 * a * gap_rounding(boxes, balls, i)
    if neglected > NEGLIGIBLE and not unresolved:
        return False, 0.0
    other = 1 - i
    t, _, _ = module_time(q, mode, other, boxes, balls, walls[other], touching[other], d, bound, sine, window, 0.0)
    clear = t >= window
    if not clear and not unresolved:
        return False, 0.0
    ledger[NEGLECTED] += neglected
    if not clear:
        return True, 0.0
    return True, total * (1.0 - j * total / (3.0 * a))


@compiled
def _settle(flow, boxes, balls, walls, touching, due, sine, cosine, elapsed, remaining, events, count, ledger):
    """Everything that happens at one instant: impacts, completed chatters, balls at rest that stick, releases.

    due: the module whose constraint is just met, or -1. Runs until nothing changes, since an impact in one module can
    release the ball of the other.
    """
    q = flow.coefficients
    pulled = due if due >= 0 and walls[due] != 0 else -1
    for i in range(2):
        if walls[i] != 0:
            continue
        relative, velocity = boxes[i] - balls[i], boxes[2 + i] - balls[2 + i]
        wall = 1 if relative > 0.0 else -1
        if i != due and 1.0 - wall * relative > gap_rounding(boxes, balls, i):
            continue
        touching = _pair(touching, i, wall)
        ledger[RESIDUAL] = max(ledger[RESIDUAL], abs(1.0 - wall * relative))
        balls = _with_position(balls, i, boxes[i] - wall)
        if abs(velocity) <= RESOLUTION * (abs(boxes[2 + i]) + abs(balls[2 + i])):
            balls = _with_velocity(balls, i, boxes[2 + i])
        elif wall * velocity > 0.0:
            brake = -wall * _acceleration(q, walls, boxes, sine)[i]
            if brake > 0.0:
                depth = velocity * velocity / (2.0 * brake)
                if depth < ledger[PIERCED]:
                    ledger[PIERCED], ledger[PIERCED_AT] = depth, elapsed
                ledger[UNDECIDED] += depth <= gap_rounding(boxes, balls, i)
            box, ball = _impact(q.epsilon, q.kappa, boxes[2 + i], balls[2 + i])
            boxes, balls = _with_velocity(boxes, i, box), _with_velocity(balls, i, ball)
            count = _record(events, count, elapsed, i, wall, IMPACT, boxes, balls)
            done, end = _end_of_chatter(flow, boxes, balls, walls, touching, sine, cosine, remaining, i, ledger)
            if done:
                common = (boxes[2 + i] + q.epsilon * balls[2 + i]) / (1.0 + q.epsilon)
                boxes, balls = _with_velocity(boxes, i, common), _with_velocity(balls, i, common)
                walls, touching = _pair(walls, i, wall), _pair(touching, i, 0)
                ledger[CHATTERS] += 1
                later, there = glide(flow, boxes, balls, walls, sine, cosine, end)
                count = _record(events, count, elapsed + end, i, wall, STICK, later, there)
    for i in range(2):
        if walls[i] == 0 and (touching[i] == 0 or boxes[2 + i] != balls[2 + i]):
            continue
        d = derivatives(q, mode_of(walls), boxes, sine, cosine)
        if walls[i] != 0:
            falling = i == pulled and walls[i] * d[2 + i] < 0.0
            if falling or _push(q, d, boxes, i, walls[i], True) < 0.0:
                touching, walls = _pair(touching, i, walls[i]), _pair(walls, i, 0)
                count = _record(events, count, elapsed, i, touching[i], RELEASE, boxes, balls)
        elif _push(q, d, boxes, i, touching[i], False) > 0.0:
            walls, touching = _pair(walls, i, touching[i]), _pair(touching, i, 0)
            count = _record(events, count, elapsed, i, walls[i], STICK, boxes, balls)
    return boxes, balls, walls, touching, count


@compiled
def _taylor(boxes, d, t):
    """The boxes a very short time t (of either sign) later."""
    x1 = boxes[0] + t * (boxes[2] + t * (d[0] / 2 + t * (d[2] / 6 + t * (d[4] / 24 + t * d[6] / 120))))
    x2 = boxes[1] + t * (boxes[3] + t * (d[1] / 2 + t * (d[3] / 6 + t * (d[5] / 24 + t * d[7] / 120))))
    v1 = boxes[2] + t * (d[0] + t * (d[2] / 2 + t * (d[4] / 6 + t * d[6] / 24)))
    v2 = boxes[3] + t * (d[1] + t * (d[3] / 2 + t * (d[5] / 6 + t * d[7] / 24)))
    return x1, x2, v1, v2


@compiled
def _note_turns(flow, speeds, boxes, balls, walls, sine, cosine, early, late, now, there, ledger):
    """Relative speeds at time late of a flight; a change of sign since early is a turn, its gap goes to the ledger."""
    after = (now[2] - there[2], now[3] - there[3])
    for i in range(2):
        if walls[i] == 0 and after[i] * speeds[i] < 0.0:
            low, high = early, late
            t = early + (late - early) * abs(speeds[i]) / (abs(speeds[i]) + abs(after[i]))
            for _ in range(TURN_STEPS):  # Newton on the relative speed, kept between the ends
                x1, x2, v1, v2, force, _ = advance(
                    flow, mode_of(walls), boxes[0], boxes[1], boxes[2], boxes[3], sine, cosine, t
                )
                x = (x1, x2, v1, v2)
                speed = x[2 + i] - balls[2 + i]
                if speed * speeds[i] > 0.0:
                    low = t
                else:
                    high = t
                slope = _acceleration(flow.coefficients, walls, x, force)[i]
                newton = t - speed / slope if slope != 0.0 else low
                t = newton if low < newton < high else 0.5 * (low + high)
            x, y = glide(flow, boxes, balls, walls, sine, cosine, t)
            wall = 1.0 if speeds[i] > 0.0 else -1.0
            if wall * (x[i] - y[i]) > 0.0:
                gap = 1.0 - wall * (x[i] - y[i])
                ledger[CLEARED] = min(ledger[CLEARED], gap)
                ledger[UNDECIDED] += gap <= gap_rounding(x, y, i)
    return after


@compiled
def _fly(flow, boxes, balls, walls, touching, sine, cosine, remaining, ledger, watch):
    """The flight to the next event, the end of the run or of the table: (time, module due or -1, boxes, balls)."""
    q = flow.coefficients
    mode = mode_of(walls)
    reach = min(remaining, flow.longest)
    now, there, s, c, t, before = boxes, balls, sine, cosine, 0.0, 0.0
    ledger[FLIGHTS] += 1
    speeds = (now[2] - there[2], now[3] - there[3])
    short = SHORT * flow.unit
    aimed = -1
    while True:
        d = derivatives(q, mode, now, s, c)
        if watch:
            speeds = _note_turns(flow, speeds, boxes, balls, walls, sine, cosine, before, t, now, there, ledger)
        if t >= reach:
            return t, -1, now, there
        if aimed >= 0:
            step = wall_time(aimed, now, there, d)
            if abs(step) <= short:
                return _meet(flow, t, step, aimed, boxes, balls, walls, sine, cosine, now, d, speeds, ledger, watch)
        ledger[EVALUATIONS] += 1
        horizon = min(reach - t, LOOKAHEAD * flow.unit)
        bound = fifth_bound(q, mode, d, horizon)
        step, due, doubt, first = horizon, -1, False, horizon
        for i in range(2):
            # the second module is asked a little further, so that it cannot interfere where the first one is due
            asked = horizon if i == 0 else min(step + short, horizon)
            time, crossing, undecided = module_time(
                q, mode, i, now, there, walls[i], touching[i], d, bound, s, asked, short
            )
            first = time if i == 0 else first
            if time < step:
                step, due, doubt = time, (i if crossing else -1), undecided
        clear = (time if due == 0 else first) >= step + short
        if due >= 0 and abs(step) <= short:
            ledger[UNDECIDED] += doubt
            return _meet(flow, t, step, due, boxes, balls, walls, sine, cosine, now, d, speeds, ledger, watch)
        aimed = due if due >= 0 and clear and walls[due] == 0 and t + step + short < reach else -1
        if t + step == t:
            return t, STUCK_IN_TIME, now, there
        before, t = t, min(t + step, reach)
        x1, x2, v1, v2, s, c = advance(flow, mode, boxes[0], boxes[1], boxes[2], boxes[3], sine, cosine, t)
        now = (x1, x2, v1, v2)
        there = carry(balls, walls, now, t)
        touching = (0, 0)


@compiled
def _meet(flow, t, step, due, boxes, balls, walls, sine, cosine, now, d, speeds, ledger, watch):
    """The end of a flight at an event a very short step away: what _fly returns."""
    later = _taylor(now, d, step)
    early, t = t, max(t + step, 0.0)
    there = carry(balls, walls, later, t)
    if watch and t > early:
        _note_turns(flow, speeds, boxes, balls, walls, sine, cosine, early, t, later, there, ledger)
    return t, due, later, there


@compiled
def integrate(flow, boxes, balls, start_phase, cycles, sample_times, samples, most_events, watch):
    """Run a state over a number of forcing cycles.

    start_phase in [0, 2 pi); sample_times (n,) ascending, from the start of the run; samples (n, 8) is filled (at
    an event: the state after it). Gives up after most_events; turns before a wall go to the ledger if watch is
    set. Returns the boxes and balls at the end, the events (m, 12) as rows [time since the start, module, wall,
    kind, state after], the status and the ledger of the run.
    """
    q = flow.coefficients
    events, count = np.empty((64, 12)), 0
    ledger = np.zeros(10)
    ledger[CLEARED] = ledger[PIERCED] = math.inf
    walls, touching, due = (0, 0), (0, 0), -1
    phase, tail, revolutions, elapsed = start_phase, 0.0, 0, 0.0
    sampled, stalled = 0, 0
    while True:
        sine, cosine = math.sin(phase), math.cos(phase)
        sine, cosine = sine + cosine * tail, cosine - sine * tail
        if count + MOST_AT_ONCE > len(events):
            events = np.concatenate((events, np.empty_like(events)))
        remaining = max(((cycles - revolutions) * TWO_PI - (phase - start_phase) - tail) / q.omega, 0.0)
        boxes, balls, walls, touching, count = _settle(
            flow, boxes, balls, walls, touching, due, sine, cosine, elapsed, remaining, events, count, ledger
        )
        if remaining == 0.0:
            break
        nearest = ledger[CLEARED]
        t, due, later, there = _fly(flow, boxes, balls, walls, touching, sine, cosine, remaining, ledger, watch)
        while sampled < len(sample_times) and sample_times[sampled] < elapsed + t:
            lag = max(sample_times[sampled] - elapsed, 0.0)
            snapshot, flying = glide(flow, boxes, balls, walls, sine, cosine, lag)
            pack(snapshot, flying, samples[sampled])
            sampled += 1
        boxes, balls, touching = later, there, (0, 0)
        for i in range(2):
            if abs(boxes[i] - balls[i]) > 1.0 + 16.0 * gap_rounding(boxes, balls, i):
                return boxes, balls, events[:count], PENETRATED, ledger
        stalled = 0 if t > 0.0 else stalled + 1
        if stalled > PATIENCE or due == STUCK_IN_TIME:
            return boxes, balls, events[:count], STALLED, ledger
        if count > most_events:
            return boxes, balls, events[:count], CROWDED, ledger
        if due < 0 and t >= remaining:
            revolutions, phase, tail = cycles, start_phase, 0.0
        else:  # the rounding of every addition goes to the tail
            step = q.omega * t
            total = phase + step
            part = total - phase
            tail += (phase - (total - part)) + (step - part)
            phase = total
            if phase >= TWO_PI:
                phase, tail, revolutions = phase - TWO_PI, tail - TWO_PI_TAIL, revolutions + 1
        elapsed = (revolutions * TWO_PI + (phase - start_phase) + tail) / q.omega
        if ledger[CLEARED] < nearest:
            ledger[CLEARED_BY] = elapsed
    while sampled < len(sample_times):
        pack(boxes, balls, samples[sampled])
        sampled += 1
    return boxes, balls, events[:count], FINISHED, ledger
