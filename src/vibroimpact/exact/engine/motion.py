"""A motion as the compiled loops carry it, and how it goes on without events."""

from typing import NamedTuple

from vibroimpact.exact.engine.compiled import inlined
from vibroimpact.exact.engine.flow import advance


class Motion(NamedTuple):
    """The state at one instant of a run.

    boxes (X1, X2, X1', X2'); balls (Y1, Y2, Y1', Y2'); for each module walls, the wall that its ball sticks to, and
    touching, the wall that it touches, moving inwards or at rest, or 0; sine and cosine of the forcing phase.
    """

    boxes: tuple[float, float, float, float]
    balls: tuple[float, float, float, float]
    walls: tuple[int, int]
    touching: tuple[int, int]
    sine: float
    cosine: float


@inlined
def mode_of(walls):
    """Index of the contact state in the flow tables."""
    return (1 if walls[0] != 0 else 0) + (2 if walls[1] != 0 else 0)


@inlined
def pair(values, i, value):
    """The pair with its i-th entry replaced."""
    return (value, values[1]) if i == 0 else (values[0], value)


@inlined
def with_velocity(values, i, velocity):
    """Boxes or balls with the velocity of module i replaced."""
    return (values[0], values[1], velocity, values[3]) if i == 0 else (values[0], values[1], values[2], velocity)


@inlined
def with_position(values, i, position):
    """Boxes or balls with the position of module i replaced."""
    return (position, values[1], values[2], values[3]) if i == 0 else (values[0], position, values[2], values[3])


@inlined
def with_boxes_and_balls(motion, boxes, balls):
    """The motion with its boxes and balls replaced."""
    return Motion(boxes, balls, motion.walls, motion.touching, motion.sine, motion.cosine)


@inlined
def with_contacts(motion, i, wall, touching):
    """The motion with what ball i sticks to and touches replaced."""
    walls, touches = pair(motion.walls, i, wall), pair(motion.touching, i, touching)
    return Motion(motion.boxes, motion.balls, walls, touches, motion.sine, motion.cosine)


@inlined
def carry(balls, walls, boxes, t):
    """Balls a time t after the start of a flight, the boxes being there already."""
    y1, y2, v1, v2 = balls[0] + t * balls[2], balls[1] + t * balls[3], balls[2], balls[3]
    if walls[0] != 0:
        y1, v1 = boxes[0] - walls[0], boxes[2]
    if walls[1] != 0:
        y2, v2 = boxes[1] - walls[1], boxes[3]
    return y1, y2, v1, v2


@inlined
def glide(flow, motion, t):
    """The motion a time t later, no event in between; no ball touches a wall but those that stick."""
    boxes, sine, cosine = advance(flow, mode_of(motion.walls), motion.boxes, motion.sine, motion.cosine, t)
    return Motion(boxes, carry(motion.balls, motion.walls, boxes, t), motion.walls, (0, 0), sine, cosine)
