"""Compute flights exactly, as sums of modes of the boxes; find impacts between samples of 1 - |W| by Newton's method.

Unlike the engine of this package, this method does not prove that no event occurs between two samples.
"""

import math
from functools import lru_cache

import numpy as np

from vibroimpact.exact.engine.compiled import disk_cached
from vibroimpact.integrators.protocol import REFUSED, UNFINISHED, Method, MethodRun, failed
from vibroimpact.integrators.right_hand_side import coefficients, inlined, inlined_source
from vibroimpact.integrators.rigid_contact import (
    INITIAL_ROWS,
    SLOWEST,
    acceleration,
    first_sample_time,
    guard,
    newton_or_middle,
    resolve,
)
from vibroimpact.system.matrices import dynamic_stiffness, rate_matrix

WORST = 1e8
"""Limit on the condition number of the eigenvectors, at which rounding errors take half of the digits of the mode
amplitudes."""
TRIES, LAST_STEP = 60, 3e-8
"""Limits of Newton's method for an event: largest number of steps, and step length [tau] below which it ends. The error
after such a step is of the order of the squared step length, which is negligible."""


class Modal(Method):
    """Modal solution with sampled distances to the walls; the setting is the number of samples per cycle."""

    name, family, knob = "modal scan", "exact flow", "samples per cycle"
    settings = (8, 16, 32, 64, 128, 256)
    careful = 256
    limit = 10_000_000

    def run(self, system, state, cycles, tau0, setting):
        tables, condition = modes(system)
        if not condition < WORST:
            return failed(REFUSED, f"the boxes' eigenvectors have condition number {condition:.1g}", 0)
        start, end, step = np.array(state, dtype=float), tau0 + cycles * system.period, system.period / setting
        final, rows, samples, tau = _march(coefficients(system), tables, start, tau0, end, step, self.limit)
        if tau < end:
            return failed(UNFINISHED, f"{samples} samples reach tau = {tau:.6g}", samples, noted=rows)
        return MethodRun(final, rows, samples)


@lru_cache(maxsize=64)
def modes(system) -> tuple[tuple[np.ndarray, ...], float]:
    """Return tables of the modes in the four contact states, and the largest condition number of the eigenvectors.

    A contact state says which balls stick. The first axis of each table is the contact state. Axes of length 2 hold
    real and imaginary parts. A conjugate pair of eigenvalues gives one mode, whose shape is twice one eigenvector. The
    tables are:

    - the number of modes, shape (4,); the last mode is the forced response,
    - the rates (eigenvalues) of the modes, shape (4, 2, 5),
    - the mode shapes in [X1, X2, X1', X2'], shape (4, 2, 4, 5),
    - the matrix that turns the free motion of the boxes into the amplitudes of the free modes, shape (4, 2, 4, 4).
    """
    counts, worst = np.zeros(4, np.intp), 0.0
    rates, shapes, inverses = (np.zeros((4, *shape), complex) for shape in ((5,), (4, 5), (4, 4)))
    for m in range(4):
        stuck = bool(m & 1), bool(m & 2)
        values, vectors = np.linalg.eig(rate_matrix(system, stuck)[:4, :4])
        worst = max(worst, np.linalg.cond(vectors))
        ours = np.flatnonzero(values.imag >= 0.0)
        n, counts[m] = len(ours), len(ours) + 1
        rates[m, : n + 1] = *values[ours], 1j * system.Omega
        response = np.linalg.solve(dynamic_stiffness(system, stuck), system.forcing) / 1j
        shapes[m, :, :n] = np.where(values[ours].imag > 0.0, 2.0, 1.0) * vectors[:, ours]
        shapes[m, :, n] = *response, *(1j * system.Omega * response)
        inverses[m, :n] = np.linalg.pinv(vectors)[ours]
    parts = (np.ascontiguousarray(np.stack([table.real, table.imag], axis=1)) for table in (rates, shapes, inverses))
    return (counts, *parts), worst


@inlined()
def _turn(rates, count, t, turns):
    """Write the real and imaginary parts of exp(rate t) of each mode into `turns`, shape (2, 5)."""
    for k in range(count):
        size, angle = math.exp(rates[0, k] * t) if rates[0, k] != 0.0 else 1.0, rates[1, k] * t
        turns[0, k], turns[1, k] = size * math.cos(angle), size * math.sin(angle)


@inlined()
def _advance(turns, count, amplitudes, later):
    """Multiply the complex amplitude of each mode by its factor in `turns`; write the products into `later`."""
    for k in range(count):
        re, im, c, s = amplitudes[0, k], amplitudes[1, k], turns[0, k], turns[1, k]
        later[0, k], later[1, k] = re * c - im * s, re * s + im * c


@inlined()
def _amplitudes(s, tau, omega, count, inverse, shape, amplitudes):
    """Decompose the state s at time tau into modes; write the amplitudes of the modes into `amplitudes`, shape (2, 5).

    The last mode is the forced response.
    """
    n = count - 1
    c, d = math.cos(omega * tau), math.sin(omega * tau)
    amplitudes[0, n], amplitudes[1, n] = c, d
    for k in range(n):
        amplitudes[0, k] = amplitudes[1, k] = 0.0
    for j in range(4):
        free = s[2 * j] - (shape[0, j, n] * c - shape[1, j, n] * d)
        for k in range(n):
            amplitudes[0, k] += inverse[0, k, j] * free
            amplitudes[1, k] += inverse[1, k, j] * free


@inlined()
def _state(s, walls, count, shape, amplitudes, t, there):
    """Write the state at a time t after the start of a flight into `there`, shape (8,).

    s: state at the start of the flight. amplitudes: amplitudes of the modes at the time t.
    """
    for j in range(4):
        total = 0.0
        for k in range(count):
            total += shape[0, j, k] * amplitudes[0, k] - shape[1, j, k] * amplitudes[1, k]
        there[2 * j] = total
    for i in range(2):
        x = 2 * i
        there[x + 1] = there[x] - walls[i] if walls[i] != 0.0 else s[x + 1] + t * s[x + 5]
        there[x + 5] = there[x + 4] if walls[i] != 0.0 else s[x + 5]


@inlined()
def _guess(before, there, i, low, high):
    """Return an estimate of the time at which ball i reaches a wall; the time is between `low` and `high`.

    W is approximated by the cubic polynomial that has the values and slopes of W at the times `low` and `high`.
    """
    x = 2 * i
    wall = 1.0 if there[x] - there[x + 1] > 0.0 else -1.0
    h = high - low
    a, b = wall * (before[x] - before[x + 1]) - 1.0, wall * (there[x] - there[x + 1]) - 1.0
    p, q = h * wall * (before[x + 4] - before[x + 5]), h * wall * (there[x + 4] - there[x + 5])
    c3, c2 = 2.0 * (a - b) + p + q, 3.0 * (b - a) - 2.0 * p - q
    u = 1.0 - b / q if q > b else 0.5
    for _ in range(3):
        slope = p + u * (2.0 * c2 + 3.0 * u * c3)
        after = u - (a + u * (p + u * (c2 + u * c3))) / slope if slope > 0.0 else 0.5
        u = after if 0.0 < after < 1.0 else 0.5 * (u + 1.0)
    return low + u * h


@disk_cached(error_model="numpy", fastmath={"contract"})
def _march(q, tables, s, tau, end, step, limit):
    """Integrate to `end` with at most `limit` samples.

    Return the last state, the impacts as rows [time, module, wall, speed], the number of samples, and the time reached.
    """
    counts, all_rates, all_shapes, inverses = tables
    walls, ahead, amplitudes = np.zeros(2), np.empty((4, 2, 5)), np.empty((2, 5))
    memory = np.empty((3, 2, 5)), np.empty((3, 8)), np.empty(8)
    for m in range(4):
        _turn(all_rates[m], counts[m], step, ahead[m])
    rows, noted = resolve(tau, s, q, walls, -1, np.empty((INITIAL_ROWS, 4)), 0, SLOWEST)
    samples = 0
    while tau < end and samples < limit:
        m = (1 if walls[0] != 0.0 else 0) + (2 if walls[1] != 0.0 else 0)
        _amplitudes(s, tau, q[8], counts[m], inverses[m], all_shapes[m], amplitudes)
        flight = s, walls, counts[m], all_shapes[m], all_rates[m], amplitudes
        due, t, taken = _fly(q, flight, tau, end - tau, (step, ahead[m]), limit - samples, memory)
        samples += taken
        s[:] = memory[2]
        tau = end if due < 0 and t >= end - tau else tau + t
        if due >= 0:
            rows, noted = resolve(tau, s, q, walls, due, rows, noted, SLOWEST)
    return s, rows[:noted], samples, tau


@inlined_source()
def _fly(q, flight, tau, length, stride, most, memory):
    """Sample a flight until an event occurs, until the time `length` has passed, or until `most` samples are taken.

    Return the module of the event (-1 without an event), the time of the event, and the number of samples. The time is
    counted from the start of the flight. Write the state at this time to memory[2]. Without an event, the time and the
    state are those of the last sample.
    """
    (s, walls, count, shape, rates, amplitudes), (step, ahead), (modes, states, reached) = flight, stride, memory
    (now, trial, turns), (before, there, event) = modes, states
    low, high, due, first, regular, samples = 0.0, first_sample_time(tau, s, q, walls, step), -1, 0.0, False, 0
    before[:] = s
    while True:
        samples += 1
        last = high >= length
        if last or not regular:
            high = length if last else high
            _turn(rates, count, high, turns)
            _advance(turns, count, amplitudes, now)
        else:
            _advance(ahead, count, now, now)
        _state(s, walls, count, shape, now, high, there)
        for i in range(2):
            if guard(tau + high, there, q, walls, i) < 0.0:
                t = _event(q, flight, tau, i, (low, high), (before, there), (turns, trial), event)
                if due < 0 or t < first:
                    due, first = i, t
                    reached[:] = event
        if due >= 0:
            return due, first, samples
        if last or samples >= most:
            reached[:] = there
            return -1, high, samples
        low, high, regular = high, high + step, True
        before[:] = there


@inlined()
def _event(q, flight, tau, i, times, states, memory, event):
    """Return the time at which the function `guard` of module i falls through zero.

    The time is between the two samples at `times`. `event` receives the state at this time.
    """
    (s, walls, count, shape, rates, amplitudes), (turns, trial) = flight, memory
    (low, high), (before, there) = times, states
    t = _guess(before, there, i, low, high) if walls[i] == 0.0 else 0.5 * (low + high)
    for _ in range(TRIES):
        _turn(rates, count, t, turns)
        _advance(turns, count, amplitudes, trial)
        _state(s, walls, count, shape, trial, t, event)
        value = guard(tau + t, event, q, walls, i)
        low, high = (t, high) if value >= 0.0 else (low, t)
        x, slope = 2 * i, 0.0
        if walls[i] == 0.0:
            slope = event[x + 5] - event[x + 4] if event[x] > event[x + 1] else event[x + 4] - event[x + 5]
        moved, t = t, newton_or_middle(t, value, slope, low, high)
        if abs(t - moved) <= LAST_STEP:
            break
    for k in range(2):
        box, ball = 4 + 2 * k, 5 + 2 * k
        rate = acceleration(tau + moved, event, q, walls, k)
        for j in (box - 4, ball - 4):
            event[j] += (t - moved) * event[j + 4]
        event[box] += (t - moved) * rate
        event[ball] += (t - moved) * rate if walls[k] != 0.0 else 0.0
    return t
