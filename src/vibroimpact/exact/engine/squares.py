"""Integrals of quadratic forms along a flight, as of the squares of the boxes' positions, to rounding, as the flow is.

In flight z = [X1, X2, X1', X2', sin, cos] obeys z' = A z. Where there is damping, X_i^2 is the rate of a potential,
z S z + c t, with A' S + S A + c (sin^2 + cos^2) = X_i^2 (Lyapunov's equation): of a run count its ends, and what the
velocities lose at impacts. With hardly any damping, S is too large to leave its differences their digits; then the
integral over a time t is another quadratic form of z at the start, which a table has at the times of the flow table
(`flow`), and Gauss's rule on the Taylor polynomial there adds the rest.
"""

from functools import lru_cache
from typing import NamedTuple

import numpy as np

from vibroimpact.exact.engine.compiled import inlined
from vibroimpact.exact.engine.flow import CONTACT_STATES, flow_of, value
from vibroimpact.exact.engine.flow_tables import ORDERS
from vibroimpact.system.matrices import rate_matrix

SIZE, ENTRIES = 6, 21
ROWS, COLUMNS = np.triu_indices(SIZE)
TERMS = 24  # of the exponential series over one spacing
NODES, WEIGHTS = np.polynomial.legendre.leggauss(8)
REST = 0.5 - np.sqrt(0.15), 0.5, 0.5 + np.sqrt(0.15)
SHARES = 5 / 18, 8 / 18, 5 / 18
"""Gauss's rule with three points on [0, 1]: over half a spacing its error is below rounding."""


POSITIONS = np.stack([np.diag(np.eye(SIZE)[i]) for i in range(2)])
"""z G z is X_i^2."""
LARGEST = 1e3
"""Up to here, times the largest rate, an entry of S leaves differences their digits."""


class Squares(NamedTuple):
    """Of a system in each contact state and for each module: potentials S (4, 2, 6, 6) and drifts c (4, 2), or, where
    those will not do, zeros and forms (`integrals_of`), which else are of no times.
    """

    potentials: np.ndarray
    drifts: np.ndarray
    forms: np.ndarray


def _lyapunov():
    """For the upper triangle of S: that of A' S + S A, linear in A (36, 21, 21), and that of sin^2 + cos^2 (21,)."""
    units = np.zeros((ENTRIES, SIZE, SIZE))
    units[np.arange(ENTRIES), ROWS, COLUMNS] = units[np.arange(ENTRIES), COLUMNS, ROWS] = 1.0
    rates = np.eye(SIZE * SIZE).reshape(-1, 1, SIZE, SIZE)
    images = rates.transpose(0, 1, 3, 2) @ units + units @ rates
    return images[..., ROWS, COLUMNS].transpose(0, 2, 1), ((ROWS == COLUMNS) & (ROWS >= 4)).astype(float)


OPERATORS, FORCING = _lyapunov()


@lru_cache(maxsize=64)
def squares_of(system) -> Squares:
    """What the integrals of a system take."""
    rates = np.array([rate_matrix(system, stuck) for stuck in CONTACT_STATES])
    equations = np.zeros((4, ENTRIES + 1, ENTRIES + 1))
    equations[:, :-1, :-1] = np.tensordot(rates.reshape(4, -1), OPERATORS, 1)
    equations[:, :-1, -1] = equations[:, -1, :-1] = FORCING  # S and S + sin^2 + cos^2 do alike
    squares = np.zeros((ENTRIES + 1, 2))
    squares[0, 0] = squares[SIZE, 1] = 1.0
    try:
        solved = np.linalg.solve(equations, np.broadcast_to(squares, (4, ENTRIES + 1, 2)))
    except np.linalg.LinAlgError:
        solved = np.full((4, ENTRIES + 1, 2), np.inf)
    potentials = np.empty((4, 2, SIZE, SIZE))
    potentials[..., ROWS, COLUMNS] = potentials[..., COLUMNS, ROWS] = solved[:, :-1].transpose(0, 2, 1)
    if np.abs(solved).max() * np.abs(rates).max() < LARGEST:
        return Squares(potentials, solved[:, -1].copy(), np.empty((4, 0, 2, ENTRIES)))
    return Squares(np.zeros_like(potentials), np.zeros((4, 2)), integrals_of(system, POSITIONS))


def integrals_of(system, kernels) -> np.ndarray:
    """The forms that integrate some others, symmetric matrices G (k, 6, 6), shape (4, n, k, 21): contact state, time of
    the flow table, which G, upper triangle.

    What stands beside the diagonal is doubled, so that a form is one sum over the products of a pair.
    """
    flow = flow_of(system)
    turned = np.zeros((len(flow.rotations), 2, SIZE))
    (cosine, sine) = flow.rotations.T
    turned[:, 0, 4], turned[:, 0, 5], turned[:, 1, 4], turned[:, 1, 5] = cosine, sine, -sine, cosine
    forms = np.empty((len(flow.series), len(turned), len(kernels), SIZE, SIZE))
    for mode, series in enumerate(flow.series):
        propagators = np.swapaxes(series[:, :, [0, ORDERS, 1, ORDERS + 1]], 1, 2)
        rate = rate_matrix(system, (bool(mode & 1), bool(mode & 2)))
        forms[mode] = _summed(_over_one(rate, flow.spacing, kernels), np.concatenate([propagators, turned], axis=1))
    triangles = np.take(forms.reshape(*forms.shape[:-2], SIZE * SIZE), SIZE * ROWS + COLUMNS, axis=-1)
    return triangles * np.where(ROWS == COLUMNS, 1.0, 2.0)


def _summed(over_one, powers):
    """The forms of 0, 1, 2, ... spacings, from that of one and the propagators (n, 6, 6) over so many."""
    forms, made = np.zeros((len(powers), *over_one.shape)), 2
    forms[1] = over_one
    while made < len(powers):  # as many again: what follows a flight is carried back to its start
        last, after = made - 1, min(made - 1, len(powers) - made)
        forms[made : made + after] = forms[last] + _carried_back(forms[1 : 1 + after], powers[last])
        made += after
    return forms


def _carried_back(forms, power):
    """P^T G P for symmetric forms G (n, k, 6, 6): two products of one tall matrix in place of very many small ones."""
    half = (forms.reshape(-1, SIZE) @ power).reshape(forms.shape)
    return (np.swapaxes(half, -1, -2).reshape(-1, SIZE) @ power).reshape(forms.shape)


def _over_one(rate, spacing, kernels):
    """The forms of one spacing, shape (k, 6, 6)."""
    scaled = rate * spacing * (1 + NODES[:, None, None]) / 2
    term = np.broadcast_to(np.eye(SIZE), scaled.shape)
    power = term.copy()
    for k in range(1, TERMS):
        term = term @ scaled / k
        power += term
    power = power[:, None]
    return np.tensordot(WEIGHTS * spacing / 2, np.swapaxes(power, -1, -2) @ kernels @ power, 1)


@inlined
def potential(squares, mode, boxes, sine, cosine):
    """The potentials of X_1^2 and X_2^2 at a point of a flight."""
    z = (boxes[0], boxes[1], boxes[2], boxes[3], sine, cosine)
    one, two = 0.0, 0.0
    for a in range(SIZE):
        first, second = 0.0, 0.0
        for b in range(SIZE):
            first += squares.potentials[mode, 0, a, b] * z[b]
            second += squares.potentials[mode, 1, a, b] * z[b]
        one += z[a] * first
        two += z[a] * second
    return one, two


@inlined
def fall(squares, before, after, forcing):
    """By how much the potentials fall in an instant; before, after: contact state and boxes, in the same places.

    Where the contact state stays, only what the change of velocities adds is computed: two products instead of 36.
    """
    (mode, boxes), (later, others), (sine, cosine) = before, after, forcing
    if mode != later:
        one, two = potential(squares, mode, boxes, sine, cosine)
        there, here = potential(squares, later, others, sine, cosine)
        return one - there, two - here
    one, two, fast, slow = 0.0, 0.0, boxes[2] + others[2], boxes[3] + others[3]
    z = (2.0 * others[0], 2.0 * others[1], fast, slow, 2.0 * sine, 2.0 * cosine)
    for a in range(2, 4):
        change = boxes[a] - others[a]
        if change != 0.0:
            first, second = 0.0, 0.0
            for b in range(SIZE):
                first += squares.potentials[mode, 0, a, b] * z[b]
                second += squares.potentials[mode, 1, a, b] * z[b]
            one, two = one + change * first, two + change * second
    return one, two


@inlined
def squares_before(forms, mode, j, boxes, sine, cosine):
    """Integrals of X_1^2 and X_2^2 over a flight that starts so, until the j-th time of the flow table."""
    z = (boxes[0], boxes[1], boxes[2], boxes[3], sine, cosine)
    one, two, place = 0.0, 0.0, 0
    first, second = forms[mode, j, 0], forms[mode, j, 1]
    for a in range(SIZE):
        for b in range(a, SIZE):
            product = z[a] * z[b]
            one += first[place] * product
            two += second[place] * product
            place += 1
    return one, two


@inlined
def squares_along(p, t):
    """Integral of the square of a polynomial of degree 7, p (8,), from 0 to a short time t of either sign."""
    first, second, third = value(p, t * REST[0]), value(p, t * REST[1]), value(p, t * REST[2])
    return t * (SHARES[0] * first * first + SHARES[1] * second * second + SHARES[2] * third * third)
