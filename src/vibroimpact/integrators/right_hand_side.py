"""(10.2) between impacts as the general-purpose integrators get it: a compiled right-hand side in the public order."""

import math

import numpy as np

from vibroimpact.exact.engine.compiled import kept
from vibroimpact.system.matrices import damping_matrix, masses, rate_matrix, stiffness_matrix
from vibroimpact.system.state import BALLS, BOXES

NAMES = "k11", "k12", "k22", "c11", "c12", "c22", "f1", "f2", "omega", "epsilon", "kappa"


def coefficients(system) -> np.ndarray:
    """The numbers of (10.2), shape (11,), in the order of NAMES."""
    upper = np.triu_indices(2)
    numbers = stiffness_matrix(system)[upper], damping_matrix(system)[upper], system.forcing
    return np.concatenate([*numbers, [system.Omega, system.epsilon, system.kappa]])


@kept()
def accelerations(tau, s, q, stuck1, stuck2):
    """X1'' and X2''; a ball that sticks moves with its box as one mass 1 + epsilon."""
    sine = math.sin(q[8] * tau)
    a1 = q[6] * sine - q[0] * s[0] - q[1] * s[2] - q[3] * s[4] - q[4] * s[6]
    a2 = q[7] * sine - q[1] * s[0] - q[2] * s[2] - q[4] * s[4] - q[5] * s[6]
    return a1 / (1.0 + q[9] * stuck1), a2 / (1.0 + q[9] * stuck2)


@kept()
def rates(tau, s, q, stuck1, stuck2):
    """Derivative of the state, shape (8,), in a contact state of the balls."""
    a1, a2 = accelerations(tau, s, q, stuck1, stuck2)
    d = np.empty(8)
    d[0], d[1], d[2], d[3] = s[4], s[5], s[6], s[7]  # a slice at once would take 3 s more to compile
    d[4], d[5], d[6], d[7] = a1, stuck1 * a1, a2, stuck2 * a2
    return d


def jacobian(system, stuck) -> np.ndarray:
    """Derivative of `rates` with respect to the state, shape (8, 8): constant in each contact state."""
    boxes = rate_matrix(system, stuck)[2:4, :4]
    matrix = np.zeros((8, 8))
    matrix[:4, 4:] = np.eye(4)
    for i in range(2):
        matrix[BOXES[2 + i], BOXES] = boxes[i]
        matrix[BALLS[2 + i]] = (masses(system, stuck)[i] > 1.0) * matrix[BOXES[2 + i]]
    return matrix
