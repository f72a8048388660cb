"""Contact logic shared by the event-driven integrators, applied where an integrator has stopped at an event.

General integrators cannot treat the end of a chatter, when a ball comes to rest on a wall. So a ball whose rebound is
slower than `slow` sticks if the box presses it against the wall; the omitted impacts change the state by less than
slow^3. The result of the integrator is not checked: if it misses an impact, the ball continues beyond the wall. The
code is compiled. Coefficients q: see `right_hand_side`; impact law: see `vibroimpact.system.restitution`.
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
    """Return the value of the function that falls below zero at the next event of module i.

    This function is 1 - |W| for a flying ball, and the contact force divided by epsilon for a sticking ball.
    """
    if walls[i] != 0.0:
        return walls[i] * acceleration(tau, s, q, walls, i)
    return 1.0 - abs(s[2 * i] - s[2 * i + 1])


@disk_cached()
def resolve(tau, s, q, walls, due, rows, count, slow):
    """Update state s (8,) and walls (2,) at an event of module `due`; return the rows of impacts and their number.

    A row is [time, module, wall, speed]. At the start of a run `due` is -1. slow: see the module docstring.
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
    for i in range(2):  # an impact in one module may release the ball of the other
        if walls[i] != 0.0 and guard(tau, s, q, walls, i) < 0.0:
            walls[i] = 0.0
    return rows, count


@inlined()
def first_sample_time(tau, s, q, walls, step):
    """Return the time from `tau` to the first sample of a flight, chosen so that no short flight is missed.

    This time is `step` or, if shorter, half the expected duration of a flight that begins at a wall at `tau`.
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
    """Return t - value / slope, the result of a Newton step, or the middle of [low, high] if the result lies outside.

    A function falls below zero within [low, high]; `value` and `slope` are its value and slope at t. If `value` is 0
    and `slope` is not 0, the result is t.
    """
    after = t - value / slope if slope != 0.0 else math.inf
    return after if low <= after <= high else 0.5 * (low + high)


class Contacts:
    """Contact states and impacts of a run, for integrators without contact logic.

    numbers: result of `right_hand_side.coefficients`. walls: (2,), the wall that each ball sticks to, or 0. impacts:
    rows (time, module, wall, speed).
    """

    def __init__(self, system, slow: float):
        self.system, self.slow, self.numbers = system, slow, coefficients(system)
        self.walls, self.impacts = np.zeros(2), []

    def start(self, tau, s):
        """Update the state `s` (8,) and the contact states at the start of a run, for each ball that is on a wall.

        Depending on `s`, such a ball impacts, sticks or leaves the wall.
        """
        self.resolve(tau, s, [-1])

    def resolve(self, tau, s, due):
        """Update the state `s` (8,) in place, and the contact states, at an event of the modules `due`.

        The event is an impact, or the contact force becomes zero.
        """
        for module in due:
            rows, count = resolve(tau, s, self.numbers, self.walls, module, np.empty((2, 4)), 0, self.slow)
            self.impacts += map(tuple, rows[:count])
