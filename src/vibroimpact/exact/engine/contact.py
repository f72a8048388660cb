"""Apply a free flight, or all events of one instant, to a motion.

Each event is a row of a table: [time since the start, module, wall, kind, state after the event, forcing phase,
approach (see `record`), sine and cosine of the phase]. The row contains the forcing phase at the event, with one
exception. The stick that completes a chatter (impacts at one wall in ever shorter flights) has the phase of the last
simulated impact.

`vibroimpact.system.restitution` defines the impact law and lists all functions that implement the law.
"""

from typing import NamedTuple

import numpy as np

from vibroimpact.exact.engine.compiled import inlined, inlined_source
from vibroimpact.exact.engine.exclusion import (
    LOOKAHEAD,
    RESOLUTION,
    acceleration_rounding,
    gap_rounding,
    module_time,
    remainder,
    spread,
)
from vibroimpact.exact.engine.flow import acceleration, advance, inverse_masses, jet, mode_of
from vibroimpact.system.state import IMPACT, RELEASE, STICK

NEGLIGIBLE = 1e-18  # largest change of the state that may be neglected when a chatter is completed
HIGHEST_HOP = 1e-12  # largest height of a hop, measured in W = X - Y, at which a chatter may be completed


class Motion(NamedTuple):
    """State at one instant of a run.

    boxes: positions and velocities of the boxes, (X1, X2, X1', X2').
    balls: positions and velocities of the balls, (Y1, Y2, Y1', Y2').
    walls: for each ball, the wall (+1 or -1) to which the ball sticks, or 0.
    touching: for each free ball, the wall on which the ball rests or which the ball is just leaving, or 0.
    sine, cosine: sine and cosine of the forcing phase.
    """

    boxes: tuple[float, float, float, float]
    balls: tuple[float, float, float, float]
    walls: tuple[int, int]
    touching: tuple[int, int]
    sine: float
    cosine: float


@inlined
def pair(values, i, value):
    """Return a pair with the i-th entry replaced by a value."""
    return (value, values[1]) if i == 0 else (values[0], value)


@inlined
def with_velocity(values, i, velocity):
    """Return the state `values` of the boxes (or balls), with the velocity in module i replaced by `velocity`."""
    return values[:2] + pair(values[2:], i, velocity)


@inlined
def with_boxes_and_balls(motion, boxes, balls):
    """Return `motion` with the states of boxes and balls replaced by `boxes` and `balls`."""
    return Motion(boxes, balls, motion.walls, motion.touching, motion.sine, motion.cosine)


@inlined
def with_contacts(motion, i, wall, touching):
    """Return a motion with replaced entries of `walls` and `touching` for module i."""
    walls, touches = pair(motion.walls, i, wall), pair(motion.touching, i, touching)
    return Motion(motion.boxes, motion.balls, walls, touches, motion.sine, motion.cosine)


@inlined
def drift_balls(balls, walls, boxes, t):
    """Return the state (Y1, Y2, Y1', Y2') of the balls at a time t after the start of a flight.

    balls: state of the balls at the start of the flight. walls: the wall to which each ball sticks, or 0.
    boxes: state of the boxes at the time t. A sticking ball moves with its box.
    """
    y1, y2, v1, v2 = balls[0] + t * balls[2], balls[1] + t * balls[3], balls[2], balls[3]
    if walls[0] != 0:
        y1, v1 = boxes[0] - walls[0], boxes[2]
    if walls[1] != 0:
        y2, v2 = boxes[1] - walls[1], boxes[3]
    return y1, y2, v1, v2


@inlined
def free_flight(flow, motion, t):
    """Return the motion after a free flight of duration t, in which no event happens.

    In the result, `touching` is (0, 0), since only sticking balls touch a wall after a flight.
    """
    boxes, sine, cosine = advance(flow, mode_of(motion.walls), motion.boxes, motion.sine, motion.cosine, t)
    return Motion(boxes, drift_balls(motion.balls, motion.walls, boxes, t), motion.walls, (0, 0), sine, cosine)


EVENTS, FLIGHTS, EXCLUSIONS, UNDECIDED, CHATTERS, RESIDUAL, NEGLECTED, ENTRIES = range(8)
"""Indices of a run's counters, and their number. RESIDUAL: largest ||W| - 1| at an impact. NEGLECTED: bound on the
changes that completed chatters neglect. EXCLUSIONS: number of proofs that an interval has no event."""


class Log(NamedTuple):
    """Log of a run: `rows` of events, shape (n, ROW), and `counters`, shape (ENTRIES,).

    The number of rows in use is counters[EVENTS].
    """

    rows: np.ndarray
    counters: np.ndarray


TIME, MODULE, WALL, KIND = range(4)
PHASE, APPROACH, SINE, COSINE, ROW = 12, 13, 14, 15, 16  # indices in the row of an event; ROW is its length


@inlined
def record(log, time, i, wall, kind, boxes, balls, approach):
    """Write an event of module i (0 or 1) to the log, without the forcing phase.

    approach: for an impact, the relative velocity before the impact. For the stick that completes a chatter, `approach`
    is the relative speed after the last simulated impact. For all other events, `approach` is 0.
    """
    row = log.rows[int(log.counters[EVENTS])]
    row[0], row[1], row[2], row[3] = time, i + 1, wall, kind
    pack(boxes, balls, row[4:PHASE])
    row[APPROACH] = approach
    log.counters[EVENTS] += 1.0


@inlined
def pack(boxes, balls, state):
    """Write boxes and balls to `state` in the order [X1, Y1, X2, Y2, X1', Y1', X2', Y2']."""
    for i in range(4):
        state[2 * i] = boxes[i]
        state[2 * i + 1] = balls[i]


@inlined
def impact(q, box, ball):
    """Return the velocities (X', Y') after an impact, from the velocities `box` and `ball` before the impact.

    The factor (1 + kappa) / (1 + epsilon) is used with its rounding remainder. Otherwise the rounding error of the
    factor would repeat at every impact. The velocity of the heavier body is computed first, because this velocity
    changes less.
    """
    relative = box - ball
    gained = q.impulse * relative + q.impulse_rest * relative
    if q.epsilon > 1.0:
        ball = ball + gained
        return ball - q.kappa * relative, ball
    box = box - q.epsilon * gained
    return box, box + q.kappa * relative


@inlined
def common_velocity(q, box, ball):
    """Return the velocity of box and ball after they join, from conservation of momentum."""
    return box - q.epsilon * q.inverse_mass * (box - ball)


@inlined
def box_accelerations(q, walls, boxes, sine):
    """Return the accelerations of both boxes.

    walls: for each ball, the wall to which the ball sticks, or 0. sine: sine of the forcing phase.
    """
    return acceleration(q, inverse_masses(q, mode_of(walls)), boxes[:2], boxes[2:], (q.f1 * sine, q.f2 * sine))


@inlined
def _contact_push(q, jets, boxes, i, wall, sticking):
    """Return a number > 0 if the wall pushes the resting ball i, and < 0 if the wall would have to pull the ball.

    The number has the sign of the contact force. If the contact force is zero within rounding, the number has the sign
    of the first nonzero derivative of the force.

    There is one exception. The force on a sticking ball may be negative but increase at a rate r > 0. If the ball were
    released, it would rise to the height 2 |force|^3 / (3 r^2). If this height is below rounding, the function returns
    the number r. Since r is positive, the ball stays stuck.
    """
    p = jets[0] if i == 0 else jets[1]
    tiny = acceleration_rounding(q, boxes, i)
    force, change = 2.0 * wall * p[2], 6.0 * wall * p[3]
    if abs(force) <= tiny:
        for k in (3, 4, 5):
            if p[k] != 0.0:
                return wall * p[k]
        return 0.0
    if sticking and force < 0.0 < change and -(force**3) < tiny * change**2:
        return change
    return force


@inlined
def _hop(q, motion, i, wall):
    """Return (u, a) for ball i, which has just left a wall.

    u: speed of the ball relative to the wall. a: acceleration of the box towards the ball.
    """
    a = wall * box_accelerations(q, motion.walls, motion.boxes, motion.sine)[i]
    return -wall * (motion.boxes[2 + i] - motion.balls[2 + i]), a


@inlined_source
def _end_of_chatter(flow, motion, i, counters):
    """Return the time until the chatter of ball i ends, or -1 if the chatter cannot be completed now.

    Each hop of the ball is shorter than the hop before by the factor kappa. With u and a from `_hop`, the chatter ends
    after the time T = 2 u / (a (1 - kappa)). A stick then replaces the remaining impacts. This replacement conserves
    the momentum of box and ball. It neglects that the hops change the spring forces. The neglected effect is of the
    order u^3 / a^2.
    """
    q, boxes, balls, wall = flow.coefficients, motion.boxes, motion.balls, motion.touching[i]
    u, a = _hop(q, motion, i, wall)
    if a <= acceleration_rounding(q, boxes, i):
        return -1.0
    neglected = q.epsilon * (q.k11 + q.k22) * u**3 / (a * a * (1.0 - q.kappa**3))
    height = u * u / (2.0 * a)
    unresolved = height <= gap_rounding(q, boxes, balls, i)
    if (neglected > NEGLIGIBLE or height > HIGHEST_HOP) and not unresolved:
        return -1.0
    total = 2.0 * u / (a * (1.0 - q.kappa))
    window = 2.0 * total
    mode = mode_of(motion.walls)
    jets = jet(q, mode, boxes, motion.sine, motion.cosine)
    bound = remainder(q, mode, jets, window * q.growth)
    p = jets[0] if i == 0 else jets[1]
    if 8.0 * window * spread(p, bound, window) > a:
        return -1.0
    t, width, _ = module_time(q, motion, 1 - i, jets, bound, window, 0.0)
    clear = t >= window and not width < window
    if not clear and not unresolved:
        return -1.0
    counters[NEGLECTED] += neglected
    return total * (1.0 - 2.0 * wall * p[3] * total / a) if clear else 0.0


@inlined
def _joined(q, motion, i):
    """Return the motion after ball i sticks to its box, with the momentum of box and ball conserved."""
    boxes, balls = motion.boxes, motion.balls
    common = common_velocity(q, boxes[2 + i], balls[2 + i])
    return with_boxes_and_balls(motion, with_velocity(boxes, i, common), with_velocity(balls, i, common))


@inlined
def resolve(flow, motion, elapsed, remaining, due, log):
    """Return the motion after all events of an instant.

    elapsed: time since the start of the run. remaining: time to the end of the run.
    due: module (0 or 1) in which an event is due now, or -1.

    Impacts are applied first. Contact forces are checked after all impacts, since an impact in one module can release
    the ball of the other module. Chatters are completed last, since they end after this instant.
    """
    pulled = due if due >= 0 and motion.walls[due] != 0 else -1
    chatters = (False, False)
    for i in range(2):
        if motion.walls[i] == 0:
            motion, ends = _apply_impact(flow, motion, i, i == due, elapsed, remaining, log)
            chatters = pair(chatters, i, ends)
    for i in range(2):
        if motion.walls[i] != 0 or (motion.touching[i] != 0 and motion.boxes[2 + i] == motion.balls[2 + i]):
            motion = _stick_or_release(flow.coefficients, motion, i, i == pulled, elapsed, log)
    if chatters[0] or chatters[1]:
        motion = _complete_both(flow, motion, chatters, elapsed, log)
    return motion


@inlined_source
def _apply_impact(flow, motion, i, due, elapsed, remaining, log):
    """Apply the impact of the flying ball i if the ball has reached a wall; return (motion, soon).

    due: True if the impact is due now.
    soon: True if a chatter that starts with this impact would end within half of `remaining` and within half of
    LOOKAHEAD * flow.unit. The time LOOKAHEAD * flow.unit is the longest time that one proof covers.
    """
    q, boxes, balls = flow.coefficients, motion.boxes, motion.balls
    relative, velocity = boxes[i] - balls[i], boxes[2 + i] - balls[2 + i]
    wall = 1 if relative > 0.0 else -1
    if not due and 1.0 - wall * relative > gap_rounding(q, boxes, balls, i):
        return motion, False
    slow = RESOLUTION * (abs(boxes[2 + i]) + abs(balls[2 + i]))
    if not due and wall * velocity < -slow and wall * relative < 1.0:  # the ball moves away from the wall
        return with_contacts(motion, i, 0, wall), False
    balls = pair(balls[:2], i, boxes[i] - wall) + balls[2:]
    motion = with_contacts(with_boxes_and_balls(motion, boxes, balls), i, 0, wall)
    if abs(velocity) <= slow:
        return with_boxes_and_balls(motion, boxes, with_velocity(balls, i, boxes[2 + i])), False
    if not wall * velocity > 0.0:
        return motion, False
    log.counters[RESIDUAL] = max(log.counters[RESIDUAL], abs(1.0 - wall * relative))
    box, ball = impact(q, boxes[2 + i], balls[2 + i])
    motion = with_boxes_and_balls(motion, with_velocity(boxes, i, box), with_velocity(balls, i, ball))
    if q.kappa * abs(velocity) <= RESOLUTION * (abs(velocity) + abs(box) + abs(ball)):  # the rebound is below rounding
        motion = _joined(q, motion, i)
    record(log, elapsed, i, wall, IMPACT, motion.boxes, motion.balls, velocity)
    u, a = _hop(q, motion, i, wall)
    return motion, 4.0 * u <= a * (1.0 - q.kappa) * min(remaining, LOOKAHEAD * flow.unit)


@inlined
def _stick_or_release(q, motion, i, pulled, elapsed, log):
    """Update the contact of ball i, which rests on a wall, and return the motion.

    The ball may stick, stay stuck or be released.

    pulled: True if the release of the sticking ball i is due now.
    """
    boxes, wall, touching = motion.boxes, motion.walls[i], motion.touching[i]
    # Free and stuck balls are checked with the same acceleration of the box, computed as if the ball were stuck.
    # Otherwise a ball with almost no contact force could stick and be released endlessly.
    together = mode_of(pair(motion.walls, i, 1))
    jets = jet(q, together, boxes, motion.sine, motion.cosine)
    if wall != 0:
        falling = pulled and wall * (jets[0] if i == 0 else jets[1])[3] < 0.0
        if falling or _contact_push(q, jets, boxes, i, wall, True) < 0.0:
            record(log, elapsed, i, wall, RELEASE, boxes, motion.balls, 0.0)
            return with_contacts(motion, i, 0, wall)
    elif _contact_push(q, jets, boxes, i, touching, False) > 0.0:
        record(log, elapsed, i, touching, STICK, boxes, motion.balls, 0.0)
        return with_contacts(motion, i, touching, 0)
    return motion


@inlined_source
def _complete_both(flow, motion, chatters, elapsed, log):
    """Return the motion after completing the chatters that end soon.

    A chatter is completed by replacing its remaining impacts by a stick. The sticks are recorded in order of time.

    chatters: for each ball, True if its chatter would end soon (see `_apply_impact`).
    """
    boxes, balls = motion.boxes, motion.balls
    ends, inward = (-1.0, -1.0), (abs(boxes[2] - balls[2]), abs(boxes[3] - balls[3]))
    for i in range(2):
        if chatters[i] and motion.touching[i] != 0:
            end = _end_of_chatter(flow, motion, i, log.counters)
            ends = pair(ends, i, end)
            if end >= 0.0:
                log.counters[CHATTERS] += 1
                motion = with_contacts(_joined(flow.coefficients, motion, i), i, motion.touching[i], 0)
    for i in range(2):  # completing a chatter may release the ball of the other module
        if motion.walls[i] != 0 and ends[i] < 0.0:
            motion = _stick_or_release(flow.coefficients, motion, i, False, elapsed, log)
    sooner = 0 if ends[0] <= ends[1] else 1
    for i in (sooner, 1 - sooner):
        if ends[i] >= 0.0:
            then = free_flight(flow, motion, ends[i])
            record(log, elapsed + ends[i], i, motion.walls[i], STICK, then.boxes, then.balls, inward[i])
    return motion
