"""Compute a period of a 1:1 motion in arbitrary precision, by modes between impacts and Newton's method at impacts."""

import mpmath
import numpy as np

from vibroimpact.system.matrices import rate_matrix

ORDER = [0, 2, 4, 6, 1, 3, 5, 7]
"""Order of the components of states in this module: X1, X2, X1', X2', Y1, Y2, Y1', Y2'."""


class Stroboscope:
    """Map of a state to the state one period later; central differences give its derivative without saltation matrices.

    phases, speeds: phases of the impacts in the last period, and speeds of the balls after them, in order of time.
    """

    def __init__(self, orbit):
        self.system, self.period = orbit.system, 2 * mpmath.pi / mpmath.mpf(orbit.system.Omega)
        self.epsilon, self.kappa = mpmath.mpf(self.system.epsilon), mpmath.mpf(self.system.kappa)
        self.rates, self.modes = mpmath.eig(mpmath.matrix(rate_matrix(orbit.system).tolist()))
        self.inverse = self.modes**-1
        phases = orbit.impact_phases.ravel()
        in_order = np.argsort(np.where(phases == 0, 1.0, phases))
        self.impacts = [(self.period * mpmath.mpf(phases[k] or 1), k // 2, 1 - 2 * (k % 2)) for k in in_order]

    def __call__(self, state):
        tau, boxes, balls = mpmath.mpf(0), [*state[:4], mpmath.mpf(0), mpmath.mpf(1)], list(state[4:])
        self.phases, self.speeds = [], []
        for expected, i, wall in self.impacts:
            duration = expected - tau
            for _ in range(4):
                x, y = self._flown(boxes, balls, duration)
                duration -= (x[i] - y[i] - wall) / (x[2 + i] - y[2 + i])
            boxes, balls = self._flown(boxes, balls, duration)
            impulse = (1 + self.kappa) * (boxes[2 + i] - balls[2 + i]) / (1 + self.epsilon)
            boxes[2 + i], balls[2 + i] = boxes[2 + i] - self.epsilon * impulse, balls[2 + i] + impulse
            tau += duration
            self.phases.append(tau / self.period)
            self.speeds.append(wall * balls[2 + i])
        boxes, balls = self._flown(boxes, balls, self.period - tau)
        return mpmath.matrix(boxes[:4] + balls)

    def _flown(self, boxes, balls, duration):
        amplitudes = self.inverse * mpmath.matrix(boxes)
        grown = [a * mpmath.exp(rate * duration) for a, rate in zip(amplitudes, self.rates, strict=True)]
        moved = [entry.real for entry in self.modes * mpmath.matrix(grown)]
        return moved, [balls[0] + duration * balls[2], balls[1] + duration * balls[3], *balls[2:]]

    def jacobian(self, state):
        step, columns = mpmath.mpf(10) ** (-mpmath.mp.dps // 3), []
        for k in range(8):
            push = mpmath.matrix([step * (j == k) for j in range(8)])
            columns.append((self(state + push) - self(state - push)) / (2 * step))
        return mpmath.matrix([[column[row] for column in columns] for row in range(8)])

    def closed(self, state):
        """Return the periodic state near a state, by Newton's method with a fixed derivative, and its derivative."""
        inverse = (mpmath.eye(8) - self.jacobian(state)) ** -1
        for _ in range(6):
            state = state + inverse * (self(state) - state)
        return state, self.jacobian(state)
