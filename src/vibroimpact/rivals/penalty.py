"""Penalty contact: each wall a spring and a damper, integrated by a stiff solver.

While the ball is beyond a wall by p > 0 it feels the force k p + c p'. With the mass mu = epsilon / (1 + epsilon) of
the relative motion a contact lasts T = pi / (omega sqrt(1 - zeta^2)), omega = sqrt(k / mu), and multiplies the speed by
exp(-pi zeta / sqrt(1 - zeta^2)), zeta = c / (2 sqrt(k mu)): zeta is tuned so that this is kappa.
"""

import math

import numpy as np
from scipy.integrate import solve_ivp

from vibroimpact.exact.engine.code_cache import kept
from vibroimpact.rivals.protocol import IMPACT, REFUSED, UNFINISHED, Method, RivalRun, failed
from vibroimpact.rivals.right_hand_side import accelerations, coefficients

RELATIVE, ABSOLUTE = 1e-7, 1e-10


class Penalty(Method):
    """Compliant contact by LSODA; setting: duration T of a contact, as a fraction of the forcing period."""

    name, family, knob, order = "penalty, LSODA", "compliant contact", "contact duration", 1
    ladder = (1e-1, 3e-2, 1e-2, 3e-3, 1e-3, 3e-4, 1e-4)
    careful = 1e-4

    def run(self, system, state, cycles, tau0, setting, limit=None):
        limit = limit or self.limit
        stiffness, damping = tuned(system.epsilon, system.kappa, setting * system.period)
        numbers, s = coefficients(system), np.array(state, dtype=float)
        steps, evaluations, impacts = 0, 0, []
        for cycle in range(cycles):
            if steps >= limit:
                return failed(UNFINISHED, f"{limit} steps reach cycle {cycle}", steps, evaluations, impacts)
            tau = tau0 + cycle * system.period
            run = solve_ivp(
                _rates,
                (tau, tau0 + (cycle + 1) * system.period),
                s,
                method="LSODA",
                args=(numbers, stiffness, damping),
                events=_touching,
                rtol=RELATIVE,
                atol=ABSOLUTE,
            )
            steps, evaluations = steps + len(run.t) - 1, evaluations + run.nfev
            if not run.success:
                return failed(REFUSED, run.message, steps, evaluations, impacts)
            impacts += sorted(_touches(run, 0) + _touches(run, 1))
            s = run.y[:, -1].copy()
        return RivalRun(s, np.array(impacts, IMPACT), steps, evaluations)

    def scale(self, setting, run):
        return setting


def tuned(epsilon: float, kappa: float, duration: float) -> tuple[float, float]:
    """Stiffness and damping of a wall at which a contact lasts `duration` and has the restitution coefficient kappa."""
    mass = epsilon / (1.0 + epsilon)
    decay = -math.log(kappa)
    zeta = decay / math.hypot(math.pi, decay)
    omega = math.pi / (duration * math.sqrt(1.0 - zeta * zeta))
    return mass * omega**2, 2.0 * zeta * mass * omega


@kept()
def _force(gap, speed, stiffness, damping):
    """Force on the box (its opposite on the ball) from the wall that the ball is beyond."""
    if gap > 1.0:
        return -stiffness * (gap - 1.0) - damping * speed
    if gap < -1.0:
        return -stiffness * (gap + 1.0) - damping * speed
    return 0.0


@kept()
def _rates(tau, s, q, stiffness, damping):
    d = np.empty(8)
    d[:4] = s[4:]
    a1, a2 = accelerations(tau, s, q, 0.0, 0.0)
    p1 = _force(s[0] - s[1], s[4] - s[5], stiffness, damping)
    p2 = _force(s[2] - s[3], s[6] - s[7], stiffness, damping)
    d[4], d[5], d[6], d[7] = a1 + p1, -p1 / q[9], a2 + p2, -p2 / q[9]
    return d


def _touches(run, i):
    """The impacts of ball i in a piece of the run: where it began to go beyond a wall."""
    touches = []
    for t, s in zip(run.t_events[i], run.y_events[i], strict=True):
        wall = 1 if s[2 * i] > s[2 * i + 1] else -1
        touches.append((t, i + 1, wall, wall * (s[2 * i + 4] - s[2 * i + 5])))
    return touches


def _touch(i):
    """A function that falls through zero when ball i meets a wall."""

    def value(tau, s, numbers, stiffness, damping):
        return 1.0 - (s[2 * i] - s[2 * i + 1]) ** 2

    value.terminal, value.direction = False, -1.0
    return value


_touching = [_touch(0), _touch(1)]
