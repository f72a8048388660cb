"""Variational flow: small perturbations of the state along the flights and events of a run.

Perturbations pass a flight by its linear flow, an impact by its saltation matrix, a release by continuity (the force
vanishes there) or together with the impact that forces it, and a completed chatter by the derivative of its completion:
the infinitely many saltations it stands for are never multiplied out. Inside, states are ordered [boxes, balls];
PUBLIC_ORDER and INNER_ORDER are where both orders meet. `growth` counts sticking in the same pass.
"""

import math
from typing import NamedTuple

import numpy as np

from vibroimpact.exact.engine.compiled import compiled, inlined
from vibroimpact.exact.engine.contact import impact
from vibroimpact.exact.engine.flow import acceleration, along, inverse_masses
from vibroimpact.exact.engine.flow_tables import ORDERS
from vibroimpact.exact.engine.motion import APPROACH, PHASE, mode_of
from vibroimpact.exact.engine.replay import AFTER, BEFORE, LENGTH, WALLS, completes_chatter, start_of, walls_after
from vibroimpact.system.state import IMPACT, STICK, takes_part

PUBLIC_ORDER = np.array([0, 4, 1, 5, 2, 6, 3, 7])
"""Places in [boxes, balls] of the public state [X1, Y1, X2, Y2, X1', Y1', X2', Y2']."""
INNER_ORDER = np.argsort(PUBLIC_ORDER)


@compiled
def carried(flow, flights, events, total):
    """Return perturbations (8, k) of the initial state of a run carried to its end, in the order [boxes, balls].

    From the run's flights (replayed) and its events (`motion`); what is given is overwritten.
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
    """Fill in the product with (8, k) vectors; BLAS takes longer to prepare at this size."""
    for row in range(8):
        for column in range(vectors.shape[1]):
            total = 0.0
            for k in range(8):
                total += matrix[row, k] * vectors[k, column]
            product[row, column] = total


@compiled
def fill_flight(flow, flight, matrix):
    """Fill in the derivative (8, 8) of the state at the end of a flight by that at its start."""
    _, _, walls = start_of(flight)
    left = min(flight[LENGTH], flow.longest)
    _fill_free(flow, walls, left, matrix)
    left = flight[LENGTH] - left
    while left > 0.0:
        step, before = min(left, flow.longest), matrix.copy()
        _fill_free(flow, walls, step, matrix)
        _copy(matrix @ before, matrix)
        left -= step


@compiled
def _fill_free(flow, walls, t, matrix):
    """Fill in the derivative (8, 8) of the state after a flight of t <= flow.longest by that before."""
    mode = mode_of(walls)
    j = int(t * flow.density + 0.5)
    rest = t - j * flow.spacing
    matrix[:] = 0.0
    for k in range(4):  # without the force a box's motion is linear in the state
        p = flow.series[mode, j, k]
        matrix[0, k], matrix[1, k], matrix[2, k], matrix[3, k] = along((p[:ORDERS], p[ORDERS:]), rest)
    for i in range(2):
        if walls[i] != 0:  # the ball goes where its box goes
            _copy(matrix[i : i + 1], matrix[4 + i : 5 + i])
            _copy(matrix[2 + i : 3 + i], matrix[6 + i : 7 + i])
        else:
            matrix[4 + i, 4 + i] = matrix[6 + i, 6 + i] = 1.0
            matrix[4 + i, 6 + i] = t


@inlined
def _copy(rows, to):
    """Copy rows (n, 8); an assignment to a slice would make Numba compile a check of shapes."""
    for n in range(len(rows)):
        for k in range(8):
            to[n, k] = rows[n, k]


@compiled
def fill_event(q, flights, events, n, matrix):
    """Fill in the derivative (8, 8) of the state after event n by that before it."""
    i, wall, kind, phase = int(events[n, 1]) - 1, int(events[n, 2]), events[n, 3], events[n, PHASE]
    _, _, walls = start_of(flights[n])
    before = flights[n, AFTER:]
    if kind == IMPACT:
        after = flights[n + 1, BEFORE:AFTER]
        _impact_matrix(q, i, before, after, walls, walls_after(events, n, walls), phase, matrix)
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
    """Fill in the rate of change (8,) of a state (8,) in a contact state."""
    i1, i2 = inverse_masses(q, mode_of(walls))
    force = math.sin(phase)
    a1, a2 = acceleration(q, (i1, i2), (state[0], state[1]), (state[2], state[3]), (q.f1 * force, q.f2 * force))
    field[0], field[1], field[2], field[3] = state[2], state[3], a1, a2
    field[4], field[5] = state[6], state[7]
    field[6] = a1 if walls[0] != 0 else 0.0
    field[7] = a2 if walls[1] != 0 else 0.0


@compiled
def _impact_matrix(q, i, before, after, walls, walls_after, phase, matrix):
    """Fill in the saltation matrix (8, 8) of an impact in module i (0, 1), from the states (8,) around it.

    S = R + (f+ - R f-) n^T / (n . f-) (Aizerman and Gantmakher 1958; Leine and Nijmeijer 2004), R the impact law, n the
    normal of the wall, f- and f+ the fields around it; walls_after differs from walls where the impact releases a ball.
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
    """Fill in the derivative (8, 8) of completing a chatter of ball i that starts with an inward speed under a push.

    Box and ball keep their momentum and centre of mass. While the gap closes, springs and dampers act on the box where
    it is and not where it will stick: the time integral of the gap is 2 u^3 / (3 a^2 (1 - kappa^3)), that of its rate
    the gap itself, and both are felt to first order in the perturbation.
    """
    e = q.epsilon
    share = e / (1.0 + e)
    _fill_identity(matrix)
    for row in (i, 4 + i):
        matrix[row, :] = 0.0
        matrix[row, i], matrix[row, 4 + i] = 1.0 / (1.0 + e), share
    for row in (2 + i, 6 + i):
        matrix[row, :] = 0.0
        matrix[row, 2 + i], matrix[row, 6 + i] = 1.0 / (1.0 + e), share
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
            _copy(matrix[box : box + 1], matrix[ball : ball + 1])


class Growth(NamedTuple):
    """Growth of an orthonormal frame of k perturbations in each of the n cycles of a run.

    factors: (n, k) diagonals of R, in modulus; by rounding alone above 0 where a perturbation is lost.
    impacts, stuck: (n,) impacts, and most balls that stick at one time.
    frame: (8, k) what the frame has become, made orthonormal again.
    """

    factors: np.ndarray
    impacts: np.ndarray
    stuck: np.ndarray
    frame: np.ndarray


def growth(run, frame: np.ndarray) -> Growth:
    """Carry an orthonormal frame (8, k) along a run, made orthonormal again after every cycle by QR.

    Parameters
    ----------
    run
        A `Run`.
    frame : ndarray
        Columns in the order of the public state, 0 in the components of a module that takes no part.
    """
    flow, flights, events = run.trajectory
    factors, counts = np.empty((run.cycles, frame.shape[1])), np.zeros((run.cycles, 2), dtype=int)
    places = np.flatnonzero(takes_part(run.system)[INNER_ORDER])
    later = _carried_by_cycles(flow, flights, events, run.system.period, frame[INNER_ORDER], places, factors, counts)
    return Growth(factors, counts[:, 0], counts[:, 1], later[PUBLIC_ORDER])


@compiled
def _carried_by_cycles(flow, flights, events, period, frame, places, factors, counts):
    """Return the frame after the last cycle; fill in factors (n, k) and counts (n, 2), which are 0.

    The frame is 0 in all but some places of the state. Cuts flights at the ends of cycles: their derivative depends on
    their length and the balls that stick alone.
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
                piece[LENGTH] = step
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
    """Replace the rows of a (m, k) at some places by the Q of those rows = QR, and fill |diag R| into sizes (k,).

    Leave out the other rows, which are 0: QR would fill them with rounding errors.
    """
    q, r = np.linalg.qr(a[places])
    for row in range(len(places)):
        for k in range(a.shape[1]):
            a[places[row], k] = q[row, k]
    sizes[:] = np.abs(np.diag(r))
