"""How far rounding errors grow along a run: a unit error at its start and after every event, carried by the variational
flow.
"""

import math

import numpy as np

from vibroimpact.exact.engine.compiled import compiled, inlined, unfolded
from vibroimpact.exact.engine.replay import AFTER, BEFORE, COLUMNS, LENGTH, land
from vibroimpact.exact.engine.variation import fill_event, fill_flight
from vibroimpact.system.state import IMPACT

UNIT = np.finfo(float).eps


@compiled
def errors_of(flow, flights, events, limit):
    """Estimated error, the root mean square of the whole state's, at the start and the end of every flight of a course:
    rows (m + 1, 2); and after the last one, the final state rounded. inf from the first event (or the end) on after
    which it is above the limit.
    """
    q = flow.coefficients
    errors, known = np.full((len(flights), 2), math.inf), limit / UNIT
    covariance, matrix, product = np.zeros((8, 8)), np.empty((8, 8)), np.empty((8, 8))
    _add_rounding(q, covariance, flights[0, BEFORE:AFTER])
    for n in range(len(flights)):
        errors[n, 0] = errors[n, 1] = UNIT * _root(covariance)
        if flights[n, LENGTH] > 0.0:
            fill_flight(flow, flights[n], matrix)
            _carry(matrix, covariance, product)
            errors[n, 1] = UNIT * _root(covariance)
        if n < len(events):
            _pass(q, flights, events, n, covariance, matrix, product)
        _add_rounding(q, covariance, flights[n + 1, BEFORE:AFTER] if n < len(events) else flights[n, AFTER:])
        if not _root(covariance) <= known:  # also where it is no number: an impact without velocity
            return errors, math.inf
    return errors, UNIT * _root(covariance)


@compiled
def errors_at(flow, flights, events, times, limit):
    """Estimated errors (n,) of the states of a course at ascending times since its start: what `errors_of` would say of
    the end of a run that ends there.
    """
    q = flow.coefficients
    errors, known, start, k = np.full(len(times), math.inf), limit / UNIT, 0.0, 0
    covariance, there, matrix, product = np.zeros((8, 8)), np.zeros((8, 8)), np.empty((8, 8)), np.empty((8, 8))
    part = np.empty(COLUMNS)
    _add_rounding(q, covariance, flights[0, BEFORE:AFTER])
    for n in range(len(flights)):
        last = n == len(events)
        while k < len(times) and (last or times[k] < start + flights[n, LENGTH]):
            _copy(flights[n], part)
            _copy(covariance.flat, there.flat)
            part[LENGTH] = min(max(times[k] - start, 0.0), flights[n, LENGTH])
            land(flow, part)
            fill_flight(flow, part, matrix)
            _carry(matrix, there, product)
            _add_rounding(q, there, part[AFTER:])
            if _root(there) <= known:
                errors[k] = UNIT * _root(there)
            k += 1
        if last:
            break
        if flights[n, LENGTH] > 0.0:
            fill_flight(flow, flights[n], matrix)
            _carry(matrix, covariance, product)
        _pass(q, flights, events, n, covariance, matrix, product)
        _add_rounding(q, covariance, flights[n + 1, BEFORE:AFTER])
        if not _root(covariance) <= known:
            break
        start += flights[n, LENGTH]
    return errors


@inlined
def _pass(q, flights, events, n, covariance, matrix, product):
    """Carry a covariance over event n."""
    _add_miss(covariance, flights[n], events[n])
    fill_event(q, flights, events, n, matrix)
    _carry(matrix, covariance, product)


@inlined
def _carry(matrix, covariance, product):
    """Replace a covariance C by that of the error times a matrix M, M (M C)^T."""
    _multiply(matrix, covariance, product)
    for i in range(8):
        for j in range(i):
            product[i, j], product[j, i] = product[j, i], product[i, j]
    _multiply(matrix, product, covariance)


@inlined
def _multiply(a, b, product):
    """The product of two matrices (8, 8), of which the first is mostly zeros."""
    for i in range(8):
        for j in range(8):
            product[i, j] = 0.0
        for k in range(8):
            weight = a[i, k]
            if weight != 0.0:
                for j in range(8):
                    product[i, j] += weight * b[k, j]


@inlined
def _copy(source, target):
    """One by one: for an array into an array Numba compiles the words of an error, 2 s and never said."""
    for i in range(len(source)):
        target[i] = source[i]


@inlined
def _root(covariance):
    """Root of the trace."""
    trace = 0.0
    for k in range(8):
        trace += covariance[k, k]
    return math.sqrt(trace)


@unfolded
def _add_miss(covariance, flight, event):
    """Add to a covariance before an impact that the ball was put on its wall from where it was found."""
    if event[3] == IMPACT:
        i = int(event[1]) - 1
        miss = 1.0 - abs(flight[AFTER + i] - flight[AFTER + 4 + i])
        covariance[4 + i, 4 + i] += (miss / UNIT) ** 2


@inlined
def _add_rounding(q, covariance, state):
    """Add a unit rounding error of a state (8,), [boxes, balls], to a covariance.

    A flight sums what the force does on the way, F / Omega^2 to a position and F / Omega to a velocity, and loses the
    last digits of it however little of it is left.
    """
    speed = q.drive / max(1.0, q.omega)
    place = speed / max(1.0, q.omega)
    for k in range(8):
        swing = 0.0 if k > 3 else (place if k < 2 else speed)
        covariance[k, k] += (1.0 + abs(state[k]) + swing) ** 2
