"""Integrate with fixed steps of the classical fourth-order Runge-Kutta method; find impacts by Newton's method."""

import math

import numpy as np

from vibroimpact.exact.engine.compiled import disk_cached
from vibroimpact.integrators.protocol import UNFINISHED, Method, MethodRun, failed
from vibroimpact.integrators.right_hand_side import coefficients, derivative, inlined
from vibroimpact.integrators.rigid_contact import (
    INITIAL_ROWS,
    SLOWEST,
    first_sample_time,
    guard,
    newton_or_middle,
    resolve,
)

TRIES, LAST_STEP = 60, 1e-14
"""Limits of Newton's method for an event: largest number of steps, and step length [tau] below which it ends."""


class RungeKutta4(Method):
    """Classical Runge-Kutta method; `setting` is the number of steps per cycle."""

    name, family, knob = "RK4, compiled", "Runge-Kutta", "steps per cycle"
    settings = (16, 32, 64, 128, 256, 512, 1024, 2048)
    careful = 2048
    limit, order = 10_000_000, 4.0

    def run(self, system, state, cycles, tau0, setting):
        start, end, step = np.array(state, dtype=float), tau0 + cycles * system.period, system.period / setting
        final, rows, steps, tau = _march(coefficients(system), start, tau0, end, step, self.limit)
        if tau < end:
            return failed(UNFINISHED, f"{steps} steps reach tau = {tau:.6g}", steps, noted=rows)
        return MethodRun(final, rows, steps, 4 * steps)


@inlined()
def _step(tau, s, q, walls, h, slopes, there):
    """Write the state after one step of length h into `there`; `slopes` (4, 8) is work memory."""
    omega = q[8]
    middle = math.sin(omega * (tau + 0.5 * h))
    derivative(math.sin(omega * tau), s, q, walls, slopes[0])
    for stage in range(1, 4):
        part = h if stage == 3 else 0.5 * h
        for k in range(8):
            there[k] = s[k] + part * slopes[stage - 1, k]
        derivative(math.sin(omega * (tau + h)) if stage == 3 else middle, there, q, walls, slopes[stage])
    for k in range(8):
        there[k] = s[k] + h / 6.0 * (slopes[0, k] + 2.0 * (slopes[1, k] + slopes[2, k]) + slopes[3, k])


@inlined()
def _event(tau, s, q, walls, i, high, slopes, event):
    """Return the step length at which the function `guard` of module i falls to zero; it is at most `high`.

    `event` receives the state after this step.
    """
    low, t, x = 0.0, 0.5 * high, 2 * i
    for _ in range(TRIES):
        _step(tau, s, q, walls, t, slopes, event)
        value, slope = guard(tau + t, event, q, walls, i), 0.0
        low, high = (t, high) if value >= 0.0 else (low, t)
        if walls[i] == 0.0:
            slope = event[x + 5] - event[x + 4] if event[x] > event[x + 1] else event[x + 4] - event[x + 5]
        before, t = t, newton_or_middle(t, value, slope, low, high)
        if abs(t - before) <= LAST_STEP:
            break
    return before


@disk_cached(error_model="numpy", fastmath={"contract"})
def _march(q, s, tau, end, step, limit):
    """Integrate to `end` in at most `limit` steps.

    Return the last state, the impacts as rows [time, module, wall, speed], the number of steps, and the time reached.
    """
    walls, slopes = np.zeros(2), np.empty((4, 8))
    there, event, found = np.empty(8), np.empty(8), np.empty(8)
    rows, noted = resolve(tau, s, q, walls, -1, np.empty((INITIAL_ROWS, 4)), 0, SLOWEST)
    steps = 0
    while tau < end and steps < limit:
        steps += 1
        h = min(first_sample_time(tau, s, q, walls, step), end - tau)
        _step(tau, s, q, walls, h, slopes, there)
        due, first = -1, h
        for i in range(2):
            if guard(tau + h, there, q, walls, i) < 0.0:
                t = _event(tau, s, q, walls, i, h, slopes, event)
                if due < 0 or t < first:
                    due, first = i, t
                    found[:] = event
        last = due < 0 and h >= end - tau
        s[:] = found if due >= 0 else there
        tau = end if last else tau + first
        if due >= 0:
            rows, noted = resolve(tau, s, q, walls, due, rows, noted, SLOWEST)
    return s, rows[:noted], steps, tau
