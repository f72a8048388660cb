"""The boundary-value problems of the non-smooth temporal transformation have the exact symmetric orbits as solutions.

This implementation follows Pilipchuk (1996, 2001) and shares no code with the library; docs/methods.md derives the
equations.
"""

import numpy as np
import pytest
from scipy.linalg import eigh, expm
from scipy.optimize import root

import vibroimpact as vi
from by_hand import BoxesByHand


class TriangularTime:
    """Response of the boxes to impacts of the ball `module`, x = P(s) + Q(s) e, with s the triangular wave and e = s'.

    s = +1 at the impact on wall +1, s = -1 at the other impact, and T = 4a: P'' + a C Q' + a^2 K P = 0 and
    Q'' + a C P' + a^2 K Q = 0, with Q = 0 and P' = a epsilon V at both ends. The speed V of the ball is 1.
    """

    def __init__(self, system, module):
        hand = BoxesByHand(system)
        self.a = 0.25 * system.period
        self.kick = self.a * system.epsilon * np.eye(2)[module]
        one, zero = np.eye(2), np.zeros((2, 2))
        ka, ca = self.a**2 * hand.stiffness, self.a * hand.damping
        self.matrix = np.block(
            [[zero, zero, one, zero], [zero, zero, zero, one], [-ka, zero, zero, -ca], [zero, -ka, -ca, zero]]
        )
        whole = expm(2.0 * self.matrix)  # of P, Q, P', Q'
        free, given = [0, 1, 6, 7], np.concatenate([np.zeros(4), self.kick, np.zeros(2)])
        ends = [4, 5, 2, 3]
        self.start = given.copy()
        self.start[free] = np.linalg.solve(whole[np.ix_(ends, free)], [*self.kick, 0.0, 0.0] - whole[ends] @ given)

    def box(self, s, e):
        """Return displacements and velocities (2, 2) of the boxes at the triangular time s with slope e."""
        P, Q, dP, dQ = np.split(expm((s + 1.0) * self.matrix) @ self.start, 4)
        return np.array([P + Q * e, (dQ + dP * e) / self.a])


def triangle(phase):
    """Return the triangular wave of period 1, which is +1 at 0, and its slope, which is -1 just after 0."""
    phase = phase % 1.0
    return (1.0 - 4.0 * phase, -1.0) if phase < 0.5 else (4.0 * phase - 3.0, 1.0)


class Conditions:
    """Equations (4,) for the times t and speeds V of impacts: each ball is at its wall, and satisfies Newton's rule."""

    def __init__(self, system):
        self.system, self.times = system, [TriangularTime(system, module) for module in range(2)]
        hand = BoxesByHand(system)
        dynamic = hand.stiffness - hand.omega**2 * np.eye(2) + 1j * hand.omega * hand.damping
        self.forced = np.linalg.solve(dynamic, hand.force)

    def boxes(self, tau, t, V, impacting=None, slope=None):
        """Return displacements and velocities (2, 2); the module `impacting` has an impact at tau, with this slope."""
        wave = self.forced * np.exp(1j * self.system.Omega * tau)
        total = np.array([wave.imag, self.system.Omega * wave.real])
        for k in range(2):
            s, e = (1.0, slope) if impacting == k else triangle((tau - t[k]) / self.system.period)
            total += V[k] * self.times[k].box(s, e)
        return total

    def __call__(self, unknowns):
        t, V = unknowns[:2], unknowns[2:]
        residual = []
        for i in range(2):
            (x, before), (_, after) = (self.boxes(t[i], t, V, i, e)[:, i] for e in (1.0, -1.0))
            ball = -0.25 * self.system.period * V[i]
            residual += [x - ball - 1.0, (after - V[i]) + self.system.kappa * (before + V[i])]
        return np.array(residual)


@pytest.mark.parametrize("changes", [{}, {"f20_hat": 0.89}, {"epsilon": 1.0, "kappa": 0.3}])
def test_the_boundary_value_problem_has_the_exact_symmetric_orbits(changes, chapter):
    system = chapter(**changes)
    conditions, symmetric = Conditions(system), [orbit for orbit in vi.orbits(system) if orbit.symmetric]
    assert symmetric
    for orbit in symmetric:
        times, speeds = orbit.impact_phases[:, 0] * system.period, orbit.ball_speeds[:, 0]
        found = root(conditions, np.round([*times, *speeds], 3), tol=1e-14).x
        np.testing.assert_allclose(found, [*times, *speeds], rtol=0, atol=1e-11)
        boxes = conditions.boxes(0.0, found[:2], found[2:])
        np.testing.assert_allclose(boxes.ravel(), orbit.state[[0, 2, 4, 6]], rtol=0, atol=1e-11)


def test_impact_modes_solve_the_boundary_value_problem_without_damping(chapter):
    """The mode of frequency w is sin(w a s) / (w a cos(w a)), without a term in e."""
    system = chapter(gamma1_hat=0.0, gamma2_hat=0.0, gamma12_hat=0.0)
    squares, modes = eigh(BoxesByHand(system).stiffness)
    for module in range(2):
        time = TriangularTime(system, module)
        wa = np.sqrt(squares) * time.a
        for s in (-1.0, -0.4, 0.0, 0.7, 1.0):
            expected = modes @ (np.sin(wa * s) / (wa * np.cos(wa)) * (modes.T @ time.kick))
            np.testing.assert_allclose(time.box(s, 1.0)[0], expected, rtol=0, atol=1e-12)
            np.testing.assert_allclose(time.box(s, -1.0)[0], expected, rtol=0, atol=1e-12)
