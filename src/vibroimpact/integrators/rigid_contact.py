"""Contact logic of the event-driven integrators, applied where an integrator has stopped at an event.

General integrators cannot follow a chatter (impacts at one wall in ever shorter flights) to its end. So a ball whose
rebound is slower than `slow` sticks if the box presses it against the wall. The omitted impacts change the state by
less than slow^3. If an integrator misses an impact, the ball continues beyond the wall.

q is the result of `right_hand_side.coefficients`.
"""

import math

import numpy as np

from vibroimpact.exact.engine.compiled import disk_cached
from vibroimpact.integrators.right_hand_side import accelerations, coefficients, inlined

SLOWEST = 1e-6
"""A ball whose rebound is slower sticks at once if its box presses it against the wall. This changes the state by
epsilon SLOWEST^3, less than rounding."""
INITIAL_ROWS = 64
"""Initial number of rows for the impacts of a run."""


@inlined()
def acceleration(tau, s, q, walls, i):
    """Return X_i'' of module i in the state s (8,) at time tau."""
    return accelerations(math.sin(q[8] * tau), s, q, walls)[i]


@inlined()
def guard(tau, s, q, walls, i):
    """Return a value that falls below zero at the next event of module i.

    It is 1 - |W| for a flying ball, and the contact force / epsilon for a sticking ball.
    """
    if walls[i] != 0.0:
        return walls[i] * acceleration(tau, s, q, walls, i)
    return 1.0 - abs(s[2 * i] - s[2 * i + 1])


@disk_cached()
def resolve(tau, s, q, walls, due, rows, count, slow):
    """Update `s` and `walls` at an event of a module; return the array of all impacts and the number of impacts.

    s: state, shape (8,).
    walls: for each ball, the wall that it sticks to, or 0.
    due: index of the module with the event, or -1 at the start of a run.
    rows: array whose first `count` rows are the impacts so far, [time, module, wall, speed].
    count: number of impacts so far.
    slow: speed of rebound below which a ball sticks if its box presses it against the wall.
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
            if abs(s[x + 4] - s[x + 5]) <= slow and wall * acceleration(tau, s, q, walls, i) > 0.0:
                s[x + 4] = s[x + 5] = (s[x + 4] + q[9] * s[x + 5]) / (1.0 + q[9])
                walls[i] = wall
    for i in range(2):  # an impact in one module may release the ball of the other module
        if walls[i] != 0.0 and guard(tau, s, q, walls, i) < 0.0:
            walls[i] = 0.0
    return rows, count


@inlined()
def first_sample_time(tau, s, q, walls, step):
    """Return the time from tau to the first sample, chosen so that no short flight is missed.

    If a flight begins at a wall, this time is at most half the expected duration of the flight. Otherwise this time is
    `step`.
    """
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
    """Return the Newton step t - value / slope if it lies in [low, high], else the middle of [low, high]."""
    after = t - value / slope if slope != 0.0 else math.inf
    return after if low <= after <= high else 0.5 * (low + high)


class Contacts:
    """Contact states and impacts of a run, for integrators without contact logic.

    walls: for each ball, the wall that it sticks to, or 0. impacts: list of rows (time, module, wall, speed).
    """

    def __init__(self, system, slow: float):
        self.system, self.slow, self.numbers = system, slow, coefficients(system)
        self.walls, self.impacts = np.zeros(2), []

    def start(self, tau, s):
        """Update the state `s` (8,) and the contact states at the start of a run.

        A ball on a wall may impact or stick.
        """
        self.resolve(tau, s, [-1])

    def resolve(self, tau, s, due):
        """Update the state `s` (8,) and the contact states at an event of the modules `due`.

        The event is an impact or the end of a contact.
        """
        for module in due:
            rows, count = resolve(tau, s, self.numbers, self.walls, module, np.empty((2, 4)), 0, self.slow)
            self.impacts += map(tuple, rows[:count])
