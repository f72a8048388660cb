"""Compute the mass, damping and stiffness matrices of the boxes in (10.2).

The argument `stuck` contains one truth value per module: True if the ball of the module sticks to a wall.
"""

import numpy as np


def damping_matrix(system) -> np.ndarray:
    """Return the damping matrix of the boxes, shape (2, 2), from the left-hand sides of (10.2)."""
    coupling = system.gamma12
    return np.array([[system.gamma1 + coupling, -coupling], [-coupling, system.gamma2 + coupling]])


def stiffness_matrix(system) -> np.ndarray:
    """Return the stiffness matrix of the boxes, shape (2, 2), from the left-hand sides of (10.2)."""
    coupling = system.alpha12
    return np.array([[1.0 + coupling, -coupling], [-coupling, system.stiffness2 + coupling]])


def masses(system, stuck=(False, False)) -> np.ndarray:
    """Return the moving mass of each module in units of M, shape (2,).

    The mass is 1, or 1 + epsilon if the ball sticks to a wall of the box.
    """
    return np.array([1.0 + system.epsilon if sticks else 1.0 for sticks in stuck])


def dynamic_stiffness(system, stuck=(False, False)) -> np.ndarray:
    """Return the complex dynamic stiffness K - Omega^2 M + i Omega C of the boxes, shape (2, 2).

    M, C and K are the matrices of mass, damping and stiffness.
    """
    omega = system.Omega
    dynamic = stiffness_matrix(system) + 1j * omega * damping_matrix(system)
    dynamic[[0, 1], [0, 1]] -= omega**2 * masses(system, stuck)
    return dynamic


def rate_matrix(system, stuck=(False, False)) -> np.ndarray:
    """Return the matrix A in dz/dtau = A z, which describes the boxes and the forcing in (10.2), shape (6, 6).

    z is the vector [X1, X2, X1', X2', sin(Omega tau), cos(Omega tau)]. The solution is z(tau) = exp(A tau) z(0).
    This solution also holds at a resonance.
    """
    mass = masses(system, stuck)[:, None]
    omega = system.Omega
    rate = np.zeros((6, 6))
    rate[0:2, 2:4] = np.eye(2)
    rate[2:4, 0:2] = -stiffness_matrix(system) / mass
    rate[2:4, 2:4] = -damping_matrix(system) / mass
    rate[2:4, 4] = system.forcing / mass[:, 0]
    rate[4, 5] = omega
    rate[5, 4] = -omega
    return rate
