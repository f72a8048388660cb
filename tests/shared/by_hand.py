"""The equations (10.2) of the boxes written out, so that what checks the engine shares no code with it."""

import numpy as np
from scipy.linalg import expm


class BoxesByHand:
    """Matrices of one system: stiffness, damping (2, 2), force (2,), and the forcing frequency omega."""

    def __init__(self, system):
        e, a = system.epsilon, system.epsilon * system.alpha12_hat
        c1, c2, c12 = (e * g for g in (system.gamma1_hat, system.gamma2_hat, system.gamma12_hat))
        self.system, self.epsilon = system, e
        self.stiffness = np.array([[1 + a, -a], [-a, 1 + e * system.sigma20_hat + a]])
        self.damping = np.array([[c1 + c12, -c12], [-c12, c2 + c12]])
        self.force = e * np.array([system.f10_hat, system.f20_hat])
        self.omega = 1 + e * system.sigma_e_hat

    def rate(self, stuck):
        """Rate matrix (6, 6) of [X1, X2, X1', X2', sin, cos]; a box moves its ball where that is stuck."""
        mass = np.where(stuck, 1 + self.epsilon, 1.0)
        rate = np.zeros((6, 6))
        rate[:2, 2:4] = np.eye(2)
        rate[2:4, :2] = -self.stiffness / mass[:, None]
        rate[2:4, 2:4] = -self.damping / mass[:, None]
        rate[2:4, 4] = self.force / mass
        rate[4, 5], rate[5, 4] = self.omega, -self.omega
        return rate


class FlightsByHand(BoxesByHand):
    """States of one system without events, by scipy's matrix exponential; walls: the wall each ball sticks to, or 0."""

    def lifted(self, state, tau):
        return np.array([*state[[0, 2, 4, 6]], np.sin(self.omega * tau), np.cos(self.omega * tau)])

    def flow(self, state, walls, tau, t):
        """State a time t later."""
        z, later = expm(self.rate([w != 0 for w in walls]) * t) @ self.lifted(state, tau), np.empty(8)
        later[[0, 2, 4, 6]] = z[:4]
        for i, wall in enumerate(walls):
            ball, speed = state[2 * i + 1], state[2 * i + 5]
            later[2 * i + 1] = z[i] - wall if wall else ball + t * speed
            later[2 * i + 5] = z[2 + i] if wall else speed
        return later

    def acceleration(self, state, walls, tau):
        """Box accelerations, shape (2,)."""
        return (self.rate([w != 0 for w in walls]) @ self.lifted(state, tau))[2:4]
