"""State of a motion in compiled code, its free flight, and the table of its events.

A row of the table is [time since the start, module, wall, kind, state after, forcing phase when it was recorded,
approach, sine and cosine of the phase]. The stick that completes a chatter is recorded at the last simulated impact of
the chatter. Counters hold the other data that the certificate needs.
"""

from typing import NamedTuple

import numpy as np

from vibroimpact.exact.engine.compiled import inlined
from vibroimpact.exact.engine.flow import advance


class Motion(NamedTuple):
    """State at one instant of a run.

    boxes: (X1, X2, X1', X2'); balls: (Y1, Y2, Y1', Y2'). walls: for each module, the wall that its ball sticks to, or
    0. touching: the wall that it touches, moving inwards or at rest, or 0. sine, cosine: of the forcing phase.
    """

    boxes: tuple[float, float, float, float]
    balls: tuple[float, float, float, float]
    walls: tuple[int, int]
    touching: tuple[int, int]
    sine: float
    cosine: float


@inlined
def mode_of(walls):
    """Return the index of the contact state in the flow tables."""
    return (1 if walls[0] != 0 else 0) + (2 if walls[1] != 0 else 0)


@inlined
def pair(values, i, value):
    """Return the pair with its i-th entry replaced."""
    return (value, values[1]) if i == 0 else (values[0], value)


@inlined
def with_velocity(values, i, velocity):
    """Return boxes or balls with the velocity of module i replaced."""
    return (values[0], values[1], velocity, values[3]) if i == 0 else (values[0], values[1], values[2], velocity)


@inlined
def with_position(values, i, position):
    """Return boxes or balls with the position of module i replaced."""
    return (position, values[1], values[2], values[3]) if i == 0 else (values[0], position, values[2], values[3])


@inlined
def with_boxes_and_balls(motion, boxes, balls):
    """Return the motion with its boxes and balls replaced."""
    return Motion(boxes, balls, motion.walls, motion.touching, motion.sine, motion.cosine)


@inlined
def with_contacts(motion, i, wall, touching):
    """Return the motion with the walls that ball i sticks to and touches replaced."""
    walls, touches = pair(motion.walls, i, wall), pair(motion.touching, i, touching)
    return Motion(motion.boxes, motion.balls, walls, touches, motion.sine, motion.cosine)


@inlined
def drift_balls(balls, walls, boxes, t):
    """Return the balls a time t after the start of a flight, given the boxes at that time."""
    y1, y2, v1, v2 = balls[0] + t * balls[2], balls[1] + t * balls[3], balls[2], balls[3]
    if walls[0] != 0:
        y1, v1 = boxes[0] - walls[0], boxes[2]
    if walls[1] != 0:
        y2, v2 = boxes[1] - walls[1], boxes[3]
    return y1, y2, v1, v2


@inlined
def free_flight(flow, motion, t):
    """Return the motion a time t later if there is no event in between.

    Only sticking balls touch a wall then.
    """
    boxes, sine, cosine = advance(flow, mode_of(motion.walls), motion.boxes, motion.sine, motion.cosine, t)
    return Motion(boxes, drift_balls(motion.balls, motion.walls, boxes, t), motion.walls, (0, 0), sine, cosine)


EVENTS, FLIGHTS, EVALUATIONS, UNDECIDED, CHATTERS, RESIDUAL, NEGLECTED, ENTRIES = range(8)
"""Indices of a run's counters: five counts, the largest |W| - 1 at an impact, and the sum of the changes neglected by
completed chatters; and the number of entries."""


class Log(NamedTuple):
    """Rows of events (n, ROW); the counters (ENTRIES,) hold the number of rows in use."""

    rows: np.ndarray
    counters: np.ndarray


TIME, MODULE, WALL, KIND = range(4)
PHASE, APPROACH, SINE, COSINE, ROW = 12, 13, 14, 15, 16  # indices in a row, and its length


@inlined
def record(log, time, i, wall, kind, boxes, balls, approach):
    """Write an event of module i (0, 1), without its phase.

    approach: the relative velocity before an impact; for the stick of a completed chatter, the speed after its last
    rebound; else 0.
    """
    row = log.rows[int(log.counters[EVENTS])]
    row[0], row[1], row[2], row[3] = time, i + 1, wall, kind
    pack(boxes, balls, row[4:PHASE])
    row[APPROACH] = approach
    log.counters[EVENTS] += 1.0


@inlined
def pack(boxes, balls, state):
    """Write the state in the public order [X1, Y1, X2, Y2, X1', Y1', X2', Y2']."""
    for i in range(4):
        state[2 * i] = boxes[i]
        state[2 * i + 1] = balls[i]
