"""Growth of perturbations along a run, cycle by cycle, with the events that decide it counted in the same pass."""

import math
from typing import NamedTuple

import numpy as np

from vibroimpact.exact.engine.compiled import compiled
from vibroimpact.exact.engine.replay import LENGTH, WALLS
from vibroimpact.exact.engine.variation import INNER_ORDER, PUBLIC_ORDER, fill_event, fill_flight, fill_product
from vibroimpact.system.state import IMPACT


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
    """Carry an orthonormal frame (8, k) along a run, orthonormal again after every cycle, by QR.

    Args:
        run: a `Run`. frame: columns in the order of the public state.
    """
    flow, flights, events = run.course
    factors, counts = np.empty((run.cycles, frame.shape[1])), np.zeros((run.cycles, 2), dtype=int)
    later = _carried_by_cycles(flow, flights, events, run.system.period, frame[INNER_ORDER], factors, counts)
    return Growth(factors, counts[:, 0], counts[:, 1], later[PUBLIC_ORDER])


@compiled
def _carried_by_cycles(flow, flights, events, period, frame, factors, counts):
    """The frame after the last cycle; fills factors (n, k) and counts (n, 2), which are 0.

    Cuts flights at the ends of cycles: their derivative depends on their length and the balls that stick alone.
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
                _orthonormalize(frame, factors[cycle])
                cycle, elapsed = cycle + 1, 0.0
                counts[cycle, 1] = stuck if left > 0.0 else 0
        if n < len(events):
            counts[cycle, 0] += events[n, 3] == IMPACT
            fill_event(flow.coefficients, flights, events, n, matrix)
            fill_product(matrix, frame, later)
            frame, later = later, frame
    _orthonormalize(frame, factors[cycle])
    return frame


@compiled
def _orthonormalize(a, sizes):
    """Put Q in the place of a = QR, (m, k), and |diag R| into sizes (k,).

    By Householder's reflections, so that Q is orthonormal where columns depend on each other, too; at this size LAPACK
    takes longer to prepare.
    """
    rows, columns = a.shape
    weights = np.zeros(columns)
    for j in range(columns):
        square = 0.0
        for i in range(j, rows):
            square += a[i, j] * a[i, j]
        sizes[j] = math.sqrt(square)
        a[j, j] += math.copysign(sizes[j], a[j, j])
        if square > 0.0:
            weights[j] = 1.0 / (sizes[j] * abs(a[j, j]))
        _reflect(a, j, j + 1, weights[j])
    for j in range(columns - 1, -1, -1):  # columns of Q from the last: the reflections of the first unit vectors
        _reflect(a, j, j + 1, weights[j])
        for i in range(j + 1, rows):
            a[i, j] *= -weights[j] * a[j, j]
        a[j, j] = 1.0 - weights[j] * a[j, j] * a[j, j]
        for i in range(j):
            a[i, j] = 0.0


@compiled
def _reflect(a, j, first, weight):
    """Reflect the columns from the first one on by the vector in column j, its rows from j on."""
    rows, columns = a.shape
    for column in range(first, columns):
        product = 0.0
        for i in range(j, rows):
            product += a[i, j] * a[i, column]
        product *= weight
        for i in range(j, rows):
            a[i, column] -= product * a[i, j]
