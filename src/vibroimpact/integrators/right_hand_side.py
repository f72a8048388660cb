"""Compiled right-hand side of (10.2) between impacts, for general-purpose integrators.

States are [X1, Y1, X2, Y2, X1', Y1', X2', Y2'].
"""

import math
from functools import partial

import numpy as np

from vibroimpact.exact.engine.compiled import disk_cached
from vibroimpact.system.matrices import damping_matrix, masses, rate_matrix, stiffness_matrix
from vibroimpact.system.state import BALLS, BOXES

NAMES = "k11", "k12", "k22", "c11", "c12", "c22", "f1", "f2", "omega", "epsilon", "kappa"

inlined = partial(disk_cached, error_model="numpy", forceinline=True, _nrt=False, fastmath={"contract"})
"""Decorator for functions that run at every step; Numba inlines cached code only if this is requested."""
inlined_source = partial(disk_cached, inline="always")
"""Decorator for functions whose source is inlined, so that they round like their caller: with fused multiply-add if the
caller is compiled with the option "contract", and without in `rates`, which SciPy's integrators call."""


def coefficients(system) -> np.ndarray:
    """Return the coefficients of (10.2), shape (11,), in the order of NAMES."""
    upper = np.triu_indices(2)
    numbers = stiffness_matrix(system)[upper], damping_matrix(system)[upper], system.forcing
    return np.concatenate([*numbers, [system.Omega, system.epsilon, system.kappa]])


@inlined_source()
def accelerations(sine, s, q, walls):
    """Return X1'' and X2'' in the state s (8,), given the sine of the forcing phase.

    walls: for each ball, the wall that it sticks to, or 0.
    """
    a1 = q[6] * sine - q[0] * s[0] - q[1] * s[2] - q[3] * s[4] - q[4] * s[6]
    a2 = q[7] * sine - q[1] * s[0] - q[2] * s[2] - q[4] * s[4] - q[5] * s[6]
    return (a1 / (1.0 + q[9]) if walls[0] != 0.0 else a1), (a2 / (1.0 + q[9]) if walls[1] != 0.0 else a2)


@inlined_source()
def derivative(sine, s, q, walls, d):
    """Write the derivative of the state s (8,) into d (8,), given the sine of the forcing phase."""
    a1, a2 = accelerations(sine, s, q, walls)
    for k in range(4):
        d[k] = s[4 + k]
    d[4], d[5] = a1, a1 if walls[0] != 0.0 else 0.0
    d[6], d[7] = a2, a2 if walls[1] != 0.0 else 0.0


@disk_cached()
def rates(tau, s, q, walls):
    """Return the derivative of the state s, shape (8,), at time tau."""
    d = np.empty(8)
    derivative(math.sin(q[8] * tau), s, q, walls, d)
    return d


def jacobian(system, stuck) -> np.ndarray:
    """Return the derivative of `rates` with respect to the state, shape (8, 8).

    stuck: booleans, shape (2,), True for a ball that sticks to a wall.
    """
    boxes = rate_matrix(system, stuck)[2:4, :4]
    matrix = np.zeros((8, 8))
    matrix[:4, 4:] = np.eye(4)
    for i in range(2):
        matrix[BOXES[2 + i], BOXES] = boxes[i]
        matrix[BALLS[2 + i]] = (masses(system, stuck)[i] > 1.0) * matrix[BOXES[2 + i]]
    return matrix
