"""A motion as the compiled loops carry it: boxes (X1, X2, X1', X2'), balls (Y1, Y2, Y1', Y2'), and for each module the
wall that its ball sticks to, or 0.
"""

from vibroimpact.exact.engine.compiled import compiled, inlined
from vibroimpact.exact.engine.flow import advance


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
    later, _, _ = advance(flow, mode_of(walls), boxes, sine, cosine, t)
    return later, carry(balls, walls, later, t)
