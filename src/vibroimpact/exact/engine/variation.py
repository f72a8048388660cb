"""Replay the flights of a finished run from its events, and propagate perturbations of the state along the run.

A flight multiplies perturbations by the derivative of its final state with respect to its initial state. An impact
multiplies perturbations by the saltation matrix. If the impact forces a release of the other ball, the saltation matrix
includes this release. Any other release leaves perturbations unchanged, since the contact force is then zero. For a
completed chatter, one matrix replaces infinitely many saltation matrices.

In this file, states are ordered [boxes, balls]. PUBLIC_ORDER converts them to [X1, Y1, X2, Y2, X1', Y1', X2', Y2'], and
INNER_ORDER converts back.
"""

import math
from typing import NamedTuple

import numpy as np

from vibroimpact.exact.engine.compiled import compiled, inlined, inlined_source
from vibroimpact.exact.engine.contact import (
    APPROACH,
    PHASE,
    box_accelerations,
    common_velocity,
    drift_balls,
    impact,
    pair,
    with_velocity,
)
from vibroimpact.exact.engine.flow import TWO_PI, advance, advance_phase, evaluate, mode_of
from vibroimpact.exact.engine.flow_tables import ORDERS
from vibroimpact.system.state import IMPACT, RELEASE, STICK, active_mask

LENGTH, WALLS, FORCING, BEFORE, AFTER, COLUMNS = 0, 1, 3, 4, 12, 20
"""Indices in the row of a flight: its length; the wall (or 0) to which each ball sticks; the forcing phase and the
state (8,) at its start; the state (8,) at its end. States are ordered [boxes, balls]."""
PUBLIC_ORDER = np.array([0, 4, 1, 5, 2, 6, 3, 7])
"""Index in [boxes, balls] of each component of the public state [X1, Y1, X2, Y2, X1', Y1', X2', Y2']."""
INNER_ORDER = np.argsort(PUBLIC_ORDER)


@compiled
def replayed(flow, start, events, start_phase, duration):
    """Return the flights of a run as rows: one flight before each event, and one from the last event to the end.

    start: initial state [X1, Y1, X2, Y2, X1', Y1', X2', Y2']. events: rows of m events.
    The result has shape (m + 1, COLUMNS). The flight before a stick event that completes a chatter has zero length.
    """
    q, flights = flow.coefficients, np.zeros((len(events) + 1, COLUMNS))
    leaving = first_departure(start, start_phase)
    for n in range(len(flights)):
        flight = flights[n]
        flight[WALLS], flight[WALLS + 1], flight[FORCING] = leaving.walls[0], leaving.walls[1], leaving.phase
        for k in range(4):
            flight[BEFORE + k], flight[BEFORE + 4 + k] = leaving.boxes[k], leaving.balls[k]
        following = next_departure(q, events, n, leaving, (duration, start_phase))
        # phases are more accurate than times, so the difference of phases corrects the difference of times
        lapse, turned = following.time - leaving.time, following.phase - leaving.phase
        more = turned - q.omega * lapse
        flight[LENGTH] = max(lapse + (more - TWO_PI * math.floor(more / TWO_PI + 0.5)) / q.omega, 0.0)
        fill_end(flow, flight)
        leaving = following
    return flights


class Departure(NamedTuple):
    """Start of a flight: boxes and balls, the wall (or 0) to which each ball sticks, the time and the forcing phase."""

    boxes: tuple[float, float, float, float]
    balls: tuple[float, float, float, float]
    walls: tuple[int, int]
    time: float
    phase: float


@inlined
def first_departure(start, phase):
    """Return the `Departure` of the first flight of a run from `start` = [X1, Y1, X2, Y2, X1', Y1', X2', Y2']."""
    return Departure(
        (start[0], start[2], start[4], start[6]), (start[1], start[3], start[5], start[7]), (0, 0), 0.0, phase
    )


@inlined
def next_departure(q, events, n, leaving, end):
    """Return the `Departure` of the flight after event n.

    leaving: `Departure` of the flight before event n. end: (time, phase) at the end of the run.
    If n is the number of events, return `leaving` with its time and phase replaced by `end`.
    """
    if n == len(events):
        return Departure(leaving.boxes, leaving.balls, leaving.walls, end[0], end[1])
    event, walls = events[n], leaving.walls
    i = int(event[1]) - 1
    if event[3] != IMPACT:
        walls = pair(walls, i, int(event[2]) if event[3] == STICK else 0)
    if completes_chatter(events, n):  # box and ball move together from this event on
        boxes, balls = leaving.boxes, leaving.balls
        common = common_velocity(q, boxes[2 + i], balls[2 + i])
        boxes, balls = with_velocity(boxes, i, common), with_velocity(balls, i, common)
        return Departure(boxes, balls, walls, leaving.time, leaving.phase)
    boxes, balls = (event[4], event[6], event[8], event[10]), (event[5], event[7], event[9], event[11])
    return Departure(boxes, balls, walls, event[0], event[PHASE])


@inlined_source
def fill_end(flow, flight):
    """Compute the state at the end of a flight and write it to the row of the flight."""
    boxes, balls, walls = start_of(flight)
    left, phase, tail = flight[LENGTH], flight[FORCING], 0.0
    while left > 0.0:
        t = min(left, flow.longest)
        later, _, _ = advance(flow, mode_of(walls), boxes, math.sin(phase), math.cos(phase), t)
        boxes, balls = later, drift_balls(balls, walls, later, t)
        phase, tail = advance_phase(phase, tail, flow.coefficients.omega, t)
        left -= t
    for k in range(4):
        flight[AFTER + k], flight[AFTER + 4 + k] = boxes[k], balls[k]


@inlined
def start_of(flight):
    """Return (boxes, balls, walls) at the start of a flight."""
    s = flight[BEFORE:AFTER]
    return (s[0], s[1], s[2], s[3]), (s[4], s[5], s[6], s[7]), (int(flight[WALLS]), int(flight[WALLS + 1]))


@inlined
def end_of(flight):
    """Return (boxes, balls) at the end of a flight."""
    s = flight[AFTER:]
    return (s[0], s[1], s[2], s[3]), (s[4], s[5], s[6], s[7])


@inlined
def completes_chatter(events, n):
    """Return True if event n is a stick event that completes a chatter."""
    return events[n, 3] == STICK and events[n, APPROACH] > 0.0


def rests_at_start(events, n):
    """Return True if event n is the stick event of a ball that rests on its wall at the start of the run."""
    first = events[n, 0] == 0.0 and events[n, 3] == STICK
    for k in range(n):
        first = first and events[k, 1] != events[n, 1]
    return first


@inlined
def walls_after(events, n, walls):
    """Return the walls to which balls stick after the releases that follow event n at the same instant."""
    for k in range(n + 1, len(events)):
        if events[k, 0] != events[n, 0]:
            break
        if events[k, 3] == RELEASE:
            walls = pair(walls, int(events[k, 1]) - 1, 0)
    return walls


@compiled
def propagate(flow, flights, events, total):
    """Return perturbations of the initial state after propagation to the end of a run.

    total: perturbations as columns, shape (8, k), with rows in the order [boxes, balls]. This array is overwritten.
    """
    matrix, later = np.empty((8, 8)), np.empty_like(total)
    for n in range(len(flights)):
        if flights[n, LENGTH] > 0.0:
            fill_flight(flow, flights[n], matrix)
            fill_product(matrix, total, later)
            total, later = later, total
        if n < len(events):
            fill_event(flow.coefficients, flights, events, n, matrix)
            fill_product(matrix, total, later)
            total, later = later, total
    return total


@compiled
def fill_product(matrix, vectors, product):
    """Write the product of `matrix`, shape (8, 8), and `vectors`, shape (8, k), to `product`.

    For such small matrices, BLAS has too much overhead.
    """
    for row in range(8):
        for column in range(vectors.shape[1]):
            total = 0.0
            for k in range(8):
                total += matrix[row, k] * vectors[k, column]
            product[row, column] = total


@compiled
def fill_flight(flow, flight, matrix):
    """Fill `matrix` with the derivative of the final state of a flight with respect to the initial state.

    matrix: shape (8, 8). The flight may be longer than `flow.longest`.
    """
    _, _, walls = start_of(flight)
    left = min(flight[LENGTH], flow.longest)
    _fill_free(flow, walls, left, matrix)
    left = flight[LENGTH] - left
    while left > 0.0:
        step, before = min(left, flow.longest), matrix.copy()
        _fill_free(flow, walls, step, matrix)
        copy((matrix @ before).flat, matrix.flat)
        left -= step


@compiled
def _fill_free(flow, walls, t, matrix):
    """Fill `matrix` with the derivative of the final state of a flight with respect to the initial state.

    matrix: shape (8, 8). t: duration of the flight, at most `flow.longest`.
    """
    mode = mode_of(walls)
    j = int(t * flow.density + 0.5)
    rest = t - j * flow.spacing
    matrix[:] = 0.0
    for k in range(4):  # column k is the response of the boxes to unit vector k, without force
        p = flow.series[mode, j, k]
        matrix[0, k], matrix[1, k], matrix[2, k], matrix[3, k] = evaluate((p[:ORDERS], p[ORDERS:]), rest)
    for i in range(2):
        if walls[i] != 0:  # the ball moves with its box
            copy(matrix[i], matrix[4 + i])
            copy(matrix[2 + i], matrix[6 + i])
        else:
            matrix[4 + i, 4 + i] = matrix[6 + i, 6 + i] = 1.0
            matrix[4 + i, 6 + i] = t


@inlined
def copy(source, target):
    """Copy entries one by one, since Numba needs 2 s more to compile an array assignment."""
    for i in range(len(source)):
        target[i] = source[i]


@compiled
def fill_event(q, flights, events, n, matrix):
    """Fill `matrix` with the derivative of the state after event n with respect to the state before event n.

    matrix: shape (8, 8).
    """
    i, wall, kind, phase = int(events[n, 1]) - 1, int(events[n, 2]), events[n, 3], events[n, PHASE]
    _, _, walls = start_of(flights[n])
    before = flights[n, AFTER:]
    if kind == IMPACT:
        after = flights[n + 1, BEFORE:AFTER]
        _saltation_matrix(q, i, before, after, walls, walls_after(events, n, walls), phase, matrix)
    elif kind == STICK:
        inward, push = 0.0, 0.0
        if completes_chatter(events, n):
            field = np.empty(8)
            fill_rate(q, walls, before, phase, field)
            inward, push = events[n, APPROACH], wall * field[2 + i]
        _stick_matrix(q, i, wall, inward, push, walls[1 - i] != 0, matrix)
    else:
        _fill_identity(matrix)


@compiled
def fill_rate(q, walls, state, phase, field):
    """Write the time derivative of a state to `field`, shape (8,).

    walls: the walls to which balls stick. state: shape (8,). phase: forcing phase.
    """
    a1, a2 = box_accelerations(q, walls, (state[0], state[1], state[2], state[3]), math.sin(phase))
    field[0], field[1], field[2], field[3] = state[2], state[3], a1, a2
    field[4], field[5] = state[6], state[7]
    field[6] = a1 if walls[0] != 0 else 0.0
    field[7] = a2 if walls[1] != 0 else 0.0


@compiled
def _saltation_matrix(q, i, before, after, walls, walls_after, phase, matrix):
    """Fill `matrix`, shape (8, 8), with the saltation matrix S of an impact in module i (0 or 1).

    S = R + (f+ - R f-) n^T / (n . f-) (Aizerman and Gantmakher 1958; Leine and Nijmeijer 2004). R is the restitution
    matrix and n the normal of the wall. The vector field is f- before the impact and f+ after the impact.

    before, after: states before and after the impact. `walls_after` differs from `walls` if the impact releases the
    other ball.
    """
    box, ball = 2 + i, 6 + i
    through, outgoing = np.empty(8), np.empty(8)
    fill_rate(q, walls, before, phase, through)
    fill_rate(q, walls_after, after, phase, outgoing)
    through[box], through[ball] = impact(q, through[box], through[ball])
    approach = before[box] - before[ball]
    _fill_identity(matrix)
    matrix[box, box], matrix[ball, box] = impact(q, 1.0, 0.0)
    matrix[box, ball], matrix[ball, ball] = impact(q, 0.0, 1.0)
    for k in range(8):
        jump = (outgoing[k] - through[k]) / approach
        matrix[k, i] += jump
        matrix[k, 4 + i] -= jump


@compiled
def _fill_identity(matrix):
    matrix[:] = 0.0
    for k in range(8):
        matrix[k, k] = 1.0


@compiled
def _stick_matrix(q, i, wall, inward, push, other_stuck, matrix):
    """Fill `matrix`, shape (8, 8), with the derivative of the state after a stick event of ball i.

    The derivative is taken with respect to the state before the event.

    inward: rebound speed u if the event completes a chatter, otherwise 0.
    push: acceleration a of the box towards the ball if the event completes a chatter, otherwise 0.
    other_stuck: True if the other ball sticks.

    Box and ball keep their common momentum and centre of mass. During a chatter, however, the box is not at the centre
    of mass. This changes the forces of springs and dampers. The matrix includes the change to first order. The
    change depends on two time integrals over the chatter. The integral of the gap is 2 u^3 / (3 a^2 (1 - kappa^3)). The
    integral of the rate of the gap is minus the initial gap.
    """
    e = q.epsilon
    share = e / (1.0 + e)
    _fill_identity(matrix)
    for k in (i, 2 + i):  # indices of the position and the velocity
        for row in (k, 4 + k):
            matrix[row, :] = 0.0
            matrix[row, k], matrix[row, 4 + k] = 1.0 / (1.0 + e), share
    by_gap = 2.0 * inward / (push * (1.0 - q.kappa**3)) if inward > 0.0 else 0.0
    by_speed = by_gap * inward / push if inward > 0.0 else 0.0
    j = 1 - i
    stiffness = (q.k11 if i == 0 else q.k22, q.k12)
    damping = (q.c11 if i == 0 else q.c22, q.c12)
    inverse = (1.0 / (1.0 + e), 1.0 / (1.0 + e) if other_stuck else 1.0)
    for k in range(2):
        box, ball = (2 + i, 6 + i) if k == 0 else (2 + j, 6 + j)
        relative = inverse[k] * share * (damping[k] - stiffness[k] * by_gap)
        speed = -inverse[k] * share * stiffness[k] * by_speed
        matrix[box, i] += relative
        matrix[box, 4 + i] -= relative
        matrix[box, 2 + i] += speed
        matrix[box, 6 + i] -= speed
        if k == 0 or other_stuck:
            copy(matrix[box], matrix[ball])


class Growth(NamedTuple):
    """Growth of k orthonormal perturbations in each of the n cycles of a run.

    factors: growth factors, shape (n, k). If sticking removes a perturbation, its factor is 0 up to rounding.
    impacts: number of impacts in each cycle, shape (n,).
    stuck: largest number of balls that stick at the same time in each cycle, shape (n,).
    frame: orthonormal perturbations at the end of the run, shape (8, k).
    """

    factors: np.ndarray
    impacts: np.ndarray
    stuck: np.ndarray
    frame: np.ndarray


def growth(run, frame: np.ndarray) -> Growth:
    """Propagate k orthonormal perturbations along a run, with a QR decomposition after every cycle.

    frame: perturbations of [X1, Y1, X2, Y2, X1', Y1', X2', Y2'] as columns, shape (8, k). The rows of an inactive
    module (`System.modules`) are 0.
    """
    flow, flights, events = run.trajectory
    factors, counts = np.empty((run.cycles, frame.shape[1])), np.zeros((run.cycles, 2), dtype=int)
    places = np.flatnonzero(active_mask(run.system)[INNER_ORDER])
    later = _propagate_by_cycles(flow, flights, events, run.system.period, frame[INNER_ORDER], places, factors, counts)
    return Growth(factors, counts[:, 0], counts[:, 1], later[PUBLIC_ORDER])


@compiled
def _propagate_by_cycles(flow, flights, events, period, frame, places, factors, counts):
    """Return the perturbations `frame`, shape (8, k), after the last cycle; fill `factors` and `counts`.

    factors: growth factors in each cycle, shape (n, k).
    counts: number of impacts and largest number of balls that stick at the same time, for each cycle, shape (n, 2),
    initially 0.
    places: indices of the rows in which the frame is not 0.
    """
    matrix, later = np.empty((8, 8)), np.empty_like(frame)
    cycle, elapsed = 0, 0.0
    for n in range(len(flights)):
        piece = flights[n].copy()
        stuck = int(piece[WALLS] != 0.0) + int(piece[WALLS + 1] != 0.0)
        left = flights[n, LENGTH]
        counts[cycle, 1] = max(counts[cycle, 1], stuck)
        while left > 0.0:
            ends = left >= period - elapsed and cycle < len(factors) - 1
            step = period - elapsed if ends else left
            if step > 0.0:
                piece[LENGTH] = step  # the derivative depends only on this length and on the balls that stick
                fill_flight(flow, piece, matrix)
                fill_product(matrix, frame, later)
                frame, later = later, frame
            left, elapsed = left - step, elapsed + step
            if ends:
                _orthonormalize(frame, places, factors[cycle])
                cycle, elapsed = cycle + 1, 0.0
                counts[cycle, 1] = stuck if left > 0.0 else 0
        if n < len(events):
            counts[cycle, 0] += events[n, 3] == IMPACT
            fill_event(flow.coefficients, flights, events, n, matrix)
            fill_product(matrix, frame, later)
            frame, later = later, frame
    _orthonormalize(frame, places, factors[cycle])
    return frame


@compiled
def _orthonormalize(a, places, sizes):
    """Orthonormalize the k columns of the array `a` in place by a QR decomposition.

    a: array of shape (m, k).
    places: indices of the rows of `a` that are not 0. The factor Q replaces these rows.
    sizes: array of shape (k,). The absolute values of the diagonal of the factor R are written to it.
    """
    q, r = np.linalg.qr(a[places])  # all other rows are 0; QR would fill them with rounding errors
    for row in range(len(places)):
        for k in range(a.shape[1]):
            a[places[row], k] = q[row, k]
    sizes[:] = np.abs(np.diag(r))
