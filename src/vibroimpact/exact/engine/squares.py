"""Integrals of quadratic forms along a flight, as of the squares of the boxes' positions, to rounding, as the flow is.

In flight z = [X1, X2, X1', X2', sin, cos] obeys z' = A z, so the integral of z G z over a time t is a quadratic form
of z at the start. A table has the form at the times of the flow table (`flow`); Gauss's rule on the Taylor polynomial
there adds the rest.
"""

from functools import lru_cache

import numpy as np

from vibroimpact.exact.engine.compiled import inlined
from vibroimpact.exact.engine.flow import flow_of, value
from vibroimpact.system.matrices import rate_matrix

SIZE, ENTRIES = 6, 21
ROWS, COLUMNS = np.triu_indices(SIZE)
TERMS = 24  # of the exponential series over one spacing, as in the flow table
NODES, WEIGHTS = np.polynomial.legendre.leggauss(8)
REST = 0.5 - np.sqrt(0.15), 0.5, 0.5 + np.sqrt(0.15)
SHARES = 5 / 18, 8 / 18, 5 / 18
"""Gauss's rule with three points on [0, 1]: over half a spacing its error is below rounding."""


POSITIONS = np.stack([np.diag(np.eye(SIZE)[i]) for i in range(2)])
"""z G z is X_i^2."""


@lru_cache(maxsize=64)
def squares_of(system) -> np.ndarray:
    """The forms of X_1^2 and X_2^2 (see `integrals_of`)."""
    return integrals_of(system, POSITIONS)


def integrals_of(system, kernels) -> np.ndarray:
    """The forms that integrate some others, symmetric matrices G (k, 6, 6), shape (4, n, k, 21): contact state, time of
    the flow table, which G, upper triangle.

    What stands beside the diagonal is doubled, so that a form is one sum over the products of a pair.
    """
    flow = flow_of(system)
    turned = np.zeros((len(flow.rotations), 2, SIZE))
    (cosine, sine) = flow.rotations.T
    turned[:, 0, 4], turned[:, 0, 5], turned[:, 1, 4], turned[:, 1, 5] = cosine, sine, -sine, cosine
    forms = np.empty((len(flow.propagators), len(turned), len(kernels), SIZE, SIZE))
    for mode, propagators in enumerate(flow.propagators):
        rate = rate_matrix(system, (bool(mode & 1), bool(mode & 2)))
        forms[mode] = _summed(_over_one(rate, flow.spacing, kernels), np.concatenate([propagators, turned], axis=1))
    return np.ascontiguousarray(forms[..., ROWS, COLUMNS] * np.where(ROWS == COLUMNS, 1.0, 2.0))


def _summed(over_one, powers):
    """The forms of 0, 1, 2, ... spacings, from that of one and the propagators (n, 6, 6) over so many."""
    forms = np.stack([np.zeros_like(over_one), over_one])
    while len(forms) < len(powers):  # as many again: what follows a flight is carried back to its start
        power = powers[len(forms) - 1]
        forms = np.concatenate([forms, forms[-1] + power.T @ forms[1:] @ power])
    return forms[: len(powers)]


def _over_one(rate, spacing, kernels):
    """The forms of one spacing, shape (k, 6, 6)."""
    forms = np.zeros(kernels.shape)
    for x, weight in zip(NODES, WEIGHTS, strict=True):
        scaled, term = rate * spacing * (1 + x) / 2, np.eye(SIZE)
        power = term.copy()
        for k in range(1, TERMS):
            term = term @ scaled / k
            power += term
        forms += weight * spacing / 2 * (power.T @ kernels @ power)
    return forms


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
