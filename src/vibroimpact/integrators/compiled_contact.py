"""The contact logic of `contact`, compiled, for methods whose whole run is compiled; q as in `right_hand_side`."""

import math
from functools import partial

import numpy as np

from vibroimpact.exact.engine.compiled import kept

inlined = partial(kept, error_model="numpy", forceinline=True, _nrt=False, fastmath={"contract"})
"""For what runs at every look: code from a cache is inlined only where it is told to be."""
SLOWEST = 1e-6
"""A ball whose rebound is slower sticks if the box presses it against the wall."""
ROOM = 64
"""Impacts that a run has room for at first."""


@inlined()
def accelerations(sine, s, q, walls):
    """X1'' and X2'' in the state s (8,) at a sine of the forcing phase; a ball that sticks moves with its box."""
    a1 = q[6] * sine - q[0] * s[0] - q[1] * s[2] - q[3] * s[4] - q[4] * s[6]
    a2 = q[7] * sine - q[1] * s[0] - q[2] * s[2] - q[4] * s[4] - q[5] * s[6]
    return (a1 / (1.0 + q[9]) if walls[0] != 0.0 else a1), (a2 / (1.0 + q[9]) if walls[1] != 0.0 else a2)


@inlined()
def acceleration(tau, s, q, walls, i):
    """X_i'' in the state s (8,) at a time."""
    return accelerations(math.sin(q[8] * tau), s, q, walls)[i]


@inlined()
def guard(tau, s, q, walls, i):
    """Function that falls below zero at the next event of module i: its gap, or the push on a ball that sticks."""
    if walls[i] != 0.0:
        return walls[i] * acceleration(tau, s, q, walls, i)
    return 1.0 - abs(s[2 * i] - s[2 * i + 1])


@kept()
def resolve(tau, s, q, walls, due, rows, count):
    """Change state s (8,) and walls (2,) at an event of module `due`; the rows of impacts, and how many there are.

    A row is [time, module, wall, speed]. At a start `due` is -1.
    """
    for i in range(2):
        x = 2 * i
        gap, speed = s[x] - s[x + 1], s[x + 4] - s[x + 5]
        wall = 1.0 if gap > 0.0 else -1.0
        if walls[i] != 0.0:
            walls[i] = 0.0 if i == due else walls[i]
        elif i == due or abs(gap) >= 1.0:
            if wall * speed > 0.0:
                if count == len(rows):
                    rows = np.concatenate((rows, np.empty_like(rows)))
                rows[count, 0], rows[count, 1], rows[count, 2], rows[count, 3] = tau, i + 1.0, wall, wall * speed
                count += 1
                impulse = (1.0 + q[10]) / (1.0 + q[9]) * speed
                s[x + 1] = s[x] - wall
                s[x + 4] -= q[9] * impulse
                s[x + 5] += impulse
            if abs(s[x + 4] - s[x + 5]) <= SLOWEST and wall * acceleration(tau, s, q, walls, i) > 0.0:
                s[x + 4] = s[x + 5] = (s[x + 4] + q[9] * s[x + 5]) / (1.0 + q[9])
                walls[i] = wall
    for i in range(2):  # an impact in one module may pull the ball off the wall in the other
        if walls[i] != 0.0 and guard(tau, s, q, walls, i) < 0.0:
            walls[i] = 0.0
    return rows, count


@inlined()
def first_look(tau, s, q, walls, step):
    """A time to look at the gaps first: a step, or half of the shortest hop that has just begun on a wall."""
    for i in range(2):
        x = 2 * i
        gap, speed = s[x] - s[x + 1], s[x + 4] - s[x + 5]
        wall = 1.0 if gap > 0.0 else -1.0
        if walls[i] == 0.0 and abs(gap) > 1.0 - 1e-12 and wall * speed < 0.0:
            push = wall * acceleration(tau, s, q, walls, i)
            step = min(step, -wall * speed / push) if push > 0.0 else step
    return step


@inlined()
def newton_or_middle(t, value, slope, low, high):
    """The next time to try for a zero that lies between low and high, where the value falls below zero."""
    after = t - value / slope if slope != 0.0 else math.inf
    return after if low < after < high else 0.5 * (low + high)
