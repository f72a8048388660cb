"""Tabulate Taylor polynomials of the linear flow z' = A z at equally spaced times.

The matrices exp(A t) are computed in double-double numbers. A double-double number is a float together with its
rounding remainder (Dekker 1971). Arrays of such matrices have shape (2, 6, 6, times). The times are the last axis, so
that one vector instruction computes a matrix entry at several times.
"""

import math

import numpy as np

from vibroimpact.exact.engine.compiled import compiled, inlined, inlined_source
from vibroimpact.exact.engine.vectors import fused

SIZE, BOXES = 6, 4  # z = [X1, X2, X1', X2', sin, cos] has 6 entries, 4 of them for the boxes
TERMS = 20  # number of terms in the series of exp(A h), where h is the table spacing; the next term is below 1e-40
ORDERS = 8  # number of coefficients in a Taylor polynomial


@compiled
def exact_rates(parameters):
    """Return (rate matrices, velocity changes, fastest rates) of n systems.

    parameters: shape (n, 10), in the order of `flow.PARAMETERS`.
    rate matrices: shape (n, 2, 4, 6, 6). The second axis is the float and its rounding remainder. The third axis is the
    contact state.
    velocity changes: the factor (1 + kappa) / (1 + epsilon) of an impact and its rounding remainder, shape (n, 2).
    fastest rates: largest natural frequency of the undamped boxes and largest eigenvalue of their damping matrix, shape
    (n, 2).

    If both boxes move equally, the forces of a stiff coupling must cancel exactly. Without the rounding remainders, the
    forces would not cancel and the lower natural frequency would shift.
    """
    n = len(parameters)
    rates, impulses, fastest = np.zeros((n, 2, 4, SIZE, SIZE)), np.empty((n, 2)), np.empty((n, 2))
    rows = np.empty((2, 2, 5))
    for k in range(n):
        e, kappa, coupling, d1, d2, d, detuning, omega, f1, f2 = parameters[k]
        mass, mass_low = _sum(1.0, 0.0, e, 0.0)
        one, one_low = _sum(1.0, 0.0, kappa, 0.0)
        impulses[k, 0], impulses[k, 1] = _ratio(one, one_low, mass, mass_low)
        for i in range(2):
            other = 1 - i
            _put(rows, i, i, -1.0, e, -coupling, -detuning if i == 1 else 0.0)
            _put(rows, i, other, 0.0, e, coupling, 0.0)
            _put(rows, i, 2 + i, 0.0, e, -d, -d2 if i == 1 else -d1)
            _put(rows, i, 2 + other, 0.0, e, d, 0.0)
            _put(rows, i, 4, 0.0, e, f2 if i == 1 else f1, 0.0)
        for mode in range(4):
            rates[k, 0, mode, 0, 2] = rates[k, 0, mode, 1, 3] = 1.0
            rates[k, 0, mode, 4, 5], rates[k, 0, mode, 5, 4] = omega, -omega
            for i in range(2):
                for j in range(5):
                    high, low = rows[0, i, j], rows[1, i, j]
                    if mode >> i & 1:
                        high, low = _ratio(high, low, mass, mass_low)
                    rates[k, 0, mode, 2 + i, j], rates[k, 1, mode, 2 + i, j] = high, low
        for j in range(2):
            middle = (rows[0, 0, 2 * j] + rows[0, 1, 2 * j + 1]) / 2
            half = (rows[0, 0, 2 * j] - rows[0, 1, 2 * j + 1]) / 2
            fastest[k, j] = math.sqrt(half * half + rows[0, 0, 2 * j + 1] ** 2) - middle
        fastest[k, 0] = math.sqrt(fastest[k, 0])
    return rates, impulses, fastest


@inlined_source
def _put(rows, i, j, base, e, first, second):
    """Set entry (i, j) of `rows` to base + e * (first + second) in double-double numbers."""
    high, low = _plus_product(base, 0.0, e, 0.0, first, 0.0)
    high, low = _plus_product(high, low, e, 0.0, second, 0.0)
    rows[0, i, j], rows[1, i, j] = _normal(high, low)


@inlined
def _ratio(high, low, other, other_low):
    """Return the quotient of two double-double numbers (high, low) and (other, other_low)."""
    quotient = high / other
    rest = (fused(-quotient, other, high) + (low - quotient * other_low)) / other
    return _normal(quotient, rest)


def tables(rates, spacing, count):
    """Return (series, rotations): flow tables for k rate matrices at the times 0, h, 2 h, ..., with h = `spacing`.

    rates: the rate matrices and their rounding remainders, shape (2, k, 6, 6).
    spacing: the time step, a power of two.
    count: number of times, at least 2.
    series: Taylor coefficients of both boxes for each initial unit vector z, shape (k, count, 6, 16). The coefficient
    of order m is at index m for X_1 and at index 8 + m for X_2.
    rotations: cosine and sine of the change of the forcing phase, shape (count, 2).
    """
    series, rotations = np.empty((rates.shape[1], count, SIZE, 2 * ORDERS)), np.empty((count, 2))
    for mode in range(rates.shape[1]):
        fill_table(rates, mode, spacing, series, rotations, 0, np.empty((2, SIZE, SIZE)))
    return series, rotations


@compiled
def fill_table(rates, mode, spacing, series, rotations, step, change):
    """Fill `series[mode]` and `rotations` as described in `tables`, and write exp(A t) - I to `change`.

    change: matrix exp(A t) - I for the time t = step * spacing, as floats and their rounding remainders, shape
    (2, 6, 6).
    """
    count = len(rotations)
    power, coefficients = np.zeros((2, SIZE, SIZE, count)), np.empty((SIZE, 2 * ORDERS))
    one, other = np.zeros((2, SIZE, SIZE, 1)), np.zeros((2, SIZE, SIZE, 1))
    _fill_unit(power, 0)
    _fill_exponential(rates, mode, spacing, power, one, other)
    last = np.intp(1)  # the literal 1 would make Numba compile `_entries` again
    while last < count - 1:
        _multiply(power, last, min(last, count - 1 - last))
        last *= 2
    _fill_coefficients(rates, mode, coefficients, one, other)
    _expand(coefficients, power, series, mode)
    for j in range(count):
        rotations[j, 0], rotations[j, 1] = power[0, BOXES, BOXES, j], power[0, BOXES, BOXES + 1, j]
    for i in range(SIZE):
        for j in range(SIZE):
            unit = 1.0 if i == j else 0.0
            change[0, i, j], change[1, i, j] = _sum(power[0, i, j, step], power[1, i, j, step], -unit, 0.0)


@inlined_source
def _fill_unit(matrices, place):
    """Set the matrix with index `place` to the identity, in double-double numbers."""
    for i in range(SIZE):
        for j in range(SIZE):
            matrices[0, i, j, place], matrices[1, i, j, place] = 1.0 if i == j else 0.0, 0.0


@inlined_source
def _fill_exponential(rates, k, spacing, powers, term, after):
    """Write the matrix exp(A h) to index 1 of `powers`, for a rate matrix A and the time step h.

    k: index of the rate matrix A in `rates`. spacing: the time step h.
    term, after: arrays for intermediate results, shape (2, 6, 6, 1).
    """
    _fill_unit(powers, 1)
    _fill_unit(term, 0)
    for order in range(1, TERMS + 1):
        for i in range(SIZE):
            for j in range(SIZE):
                high, low = 0.0, 0.0
                for n in range(SIZE):
                    if rates[0, k, n, j] != 0.0:
                        rate, rest = rates[0, k, n, j] * spacing, rates[1, k, n, j] * spacing
                        high, low = _plus_product(high, low, term[0, i, n, 0], term[1, i, n, 0], rate, rest)
                high, low = _normal(high, low)
                high, low = _ratio(high, low, 1.0 * order, 0.0)
                after[0, i, j, 0], after[1, i, j, 0] = high, low
                powers[0, i, j, 1], powers[1, i, j, 1] = _sum(powers[0, i, j, 1], powers[1, i, j, 1], high, low)
        term, after = after, term


@inlined_source
def _fill_coefficients(rates, k, rows, power, after):
    """Write the Taylor coefficients of both boxes to `rows`, shape (6, 16), one row for each initial unit vector.

    The coefficient of order m is at index m for X_1 and at index 8 + m for X_2.

    power, after: arrays for intermediate results, shape (2, 6, 6, 1).
    """
    _fill_unit(power, 0)
    for m in range(ORDERS):
        for n in range(SIZE):
            rows[n, m], rows[n, ORDERS + m] = power[0, 0, n, 0], power[0, 1, n, 0]
        for i in range(SIZE):
            for j in range(SIZE):
                total = 0.0
                for n in range(SIZE):
                    total += power[0, i, n, 0] * rates[0, k, n, j]
                after[0, i, j, 0] = total / (m + 1)
        power, after = after, power


@inlined_source
def _expand(coefficients, powers, series, mode):
    """Write the products of the Taylor coefficients with the powers exp(A j h) to series[mode].

    coefficients: Taylor coefficients at time 0, shape (6, 16). powers: shape (2, 6, 6, count).
    series[mode]: shape (count, 6, 16).
    """
    for j in range(powers.shape[3]):
        for m in range(SIZE):
            a, b, c = powers[0, 0, m, j], powers[0, 1, m, j], powers[0, 2, m, j]
            d, e, f = powers[0, 3, m, j], powers[0, 4, m, j], powers[0, 5, m, j]
            for k in range(2 * ORDERS):
                positions = a * coefficients[0, k] + b * coefficients[1, k]
                velocities = c * coefficients[2, k] + d * coefficients[3, k]
                series[mode, j, m, k] = positions + velocities + (e * coefficients[4, k] + f * coefficients[5, k])


@inlined_source
def _multiply(powers, last, many):
    """Compute `many` more powers of P = exp(A h) from the known powers P, ..., P^last."""
    for i in range(BOXES):
        for j in range(BOXES):
            _entries(powers, last, many, i, j, 0, BOXES)
        for j in range(BOXES, SIZE):
            _entries(powers, last, many, i, j, 0, SIZE)
    for i in range(BOXES, SIZE):  # the rows of the phase are zero in the columns of the boxes
        for j in range(BOXES, SIZE):
            _entries(powers, last, many, i, j, BOXES, SIZE)


@inlined
def _entries(powers, last, many, i, j, first, end):
    """Write entry (i, j) of `many` new powers, which are the products of P^last with P, P^2, ....

    The sum of each matrix product runs over first <= n < end, since all other terms are zero.
    """
    for time in range(1, many + 1):
        high, low = 0.0, 0.0
        for n in range(first, end):
            a, a_low = powers[0, i, n, time], powers[1, i, n, time]
            high, low = _plus_product(high, low, a, a_low, powers[0, n, j, last], powers[1, n, j, last])
        there = np.uintp(last + time)  # the index is unsigned, so that the compiler vectorises the loop
        powers[0, i, j, there], powers[1, i, j, there] = _normal(high, low)


@inlined
def _plus_product(high, low, a, a_low, b, b_low):
    """Return the sum of (high, low) and the product (a, a_low) * (b, b_low), as a pair (high, low).

    The pair is not yet normalised (see `_normal`).
    """
    product = a * b
    total = high + product
    part = total - high
    rounded = (high - (total - part)) + (product - part)
    return total, low + (rounded + (fused(a, b, -product) + (a * b_low + a_low * b)))


@inlined
def _sum(a, a_low, b, b_low):
    """Return the sum of two double-double numbers (a, a_low) and (b, b_low)."""
    total = a + b
    part = total - a
    return _normal(total, (a - (total - part)) + (b - part) + (a_low + b_low))


@inlined
def _normal(high, low):
    """Return high + low as a pair: the nearest float and the remainder."""
    total = high + low
    return total, low - (total - high)
