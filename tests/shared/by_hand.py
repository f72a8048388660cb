"""Equations (10.2) of the boxes written out, so that checks of the engine share no code with the engine."""

import mpmath as mp
import numpy as np
from scipy.linalg import expm


class BoxesByHand:
    """Matrices of one system: stiffness and damping, shape (2, 2), force, shape (2,), and forcing frequency omega."""

    def __init__(self, system):
        e, a = system.epsilon, system.epsilon * system.alpha12_hat
        c1, c2, c12 = (e * g for g in (system.gamma1_hat, system.gamma2_hat, system.gamma12_hat))
        self.system, self.epsilon = system, e
        self.stiffness = np.array([[1 + a, -a], [-a, 1 + e * system.sigma20_hat + a]])
        self.damping = np.array([[c1 + c12, -c12], [-c12, c2 + c12]])
        self.force = e * np.array([system.f10_hat, system.f20_hat])
        self.omega = 1 + e * system.sigma_e_hat

    def rate(self, stuck):
        """Return the rate matrix (6, 6) of [X1, X2, X1', X2', sin, cos]; a box carries its ball if the ball sticks."""
        mass = np.where(stuck, 1 + self.epsilon, 1.0)
        rate = np.zeros((6, 6), dtype=mass.dtype)  # object, if the parameters are
        rate[:2, 2:4] = np.eye(2)
        rate[2:4, :2] = -self.stiffness / mass[:, None]
        rate[2:4, 2:4] = -self.damping / mass[:, None]
        rate[2:4, 4] = self.force / mass
        rate[4, 5], rate[5, 4] = self.omega, -self.omega
        return rate


class FlightsByHand(BoxesByHand):
    """States of one system between events, by SciPy's matrix exponential.

    `walls` contains, for each ball, the wall to which it sticks, or 0.
    """

    def lifted(self, state, tau):
        """Return the vector (6,) to which `rate` applies, for a state at the time tau."""
        return np.array([*state[[0, 2, 4, 6]], np.sin(self.omega * tau), np.cos(self.omega * tau)])

    def flow(self, state, walls, tau, t):
        """Return the state after the time t without events."""
        z, later = expm(self.rate([w != 0 for w in walls]) * t) @ self.lifted(state, tau), np.empty(8)
        later[[0, 2, 4, 6]] = z[:4]
        for i, wall in enumerate(walls):
            ball, speed = state[2 * i + 1], state[2 * i + 5]
            later[2 * i + 1] = z[i] - wall if wall else ball + t * speed
            later[2 * i + 5] = z[2 + i] if wall else speed
        return later


def exact_rate(system, stuck=(False, False)):
    """Return the rate matrix of `BoxesByHand.rate` to the digits of mpmath, from the floats of a system."""
    e = mp.mpf(system.epsilon)
    k, couple = e * system.alpha12_hat, e * system.gamma12_hat
    rate = mp.matrix(6)
    rate[0, 2] = rate[1, 3] = 1
    rate[4, 5], rate[5, 4] = system.Omega, -mp.mpf(system.Omega)
    ground = system.gamma1_hat, system.gamma2_hat
    for i, (detuning, force) in enumerate(((0.0, system.f10_hat), (system.sigma20_hat, system.f20_hat))):
        mass = 1 + e if stuck[i] else mp.mpf(1)
        rate[2 + i, i], rate[2 + i, 1 - i] = -(1 + e * detuning + k) / mass, k / mass
        rate[2 + i, 2 + i], rate[2 + i, 3 - i] = -(e * ground[i] + couple) / mass, couple / mass
        rate[2 + i, 4] = e * force / mass
    return rate
