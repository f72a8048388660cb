"""Integrate by Moreau-Jean time-stepping, which locates no events (Jean 1999; Acary and Brogliato 2008)."""

import math

import numpy as np

from vibroimpact.exact.engine.compiled import disk_cached
from vibroimpact.integrators.protocol import UNFINISHED, Method, MethodRun, failed
from vibroimpact.integrators.right_hand_side import coefficients


class MoreauJean(Method):
    """Time-stepping with the trapezoidal rule; the setting is the number of steps per cycle.

    In a step with a contact, the restitution law relates the velocities before and after the step.
    """

    name, family, knob, order = "Moreau-Jean", "time-stepping", "steps per cycle", 1
    settings = (100, 300, 1_000, 3_000, 10_000, 30_000, 100_000)
    careful = 100_000
    limit = 1_000_000_000

    def run(self, system, state, cycles, tau0, setting):
        steps, step = setting * cycles, system.period / setting
        if steps > self.limit:
            return failed(UNFINISHED, f"{self.limit} steps end after {self.limit / setting:g} cycles", 0)
        final, rows = _march(coefficients(system), np.array(state, dtype=float), tau0, step, steps)
        return MethodRun(final, rows, steps)


@disk_cached()
def _march(q, s, tau0, h, steps):
    """Take `steps` steps of length h; return the last state and the contacts.

    A contact can last for several steps. Its row [time, module, wall, speed] describes the first of these steps.
    """
    k11, k12, k22, c11, c12, c22, f1, f2, omega, epsilon, kappa = q
    g = 0.5 * h
    m11, m12, m22 = 1.0 + g * (c11 + g * k11), g * (c12 + g * k12), 1.0 + g * (c22 + g * k22)
    determinant = m11 * m22 - m12 * m12
    n11, n12, n22 = m22 / determinant, -m12 / determinant, m11 / determinant
    x1, y1, x2, y2, v1, w1, v2, w2 = s
    rows = [(0.0, 0.0, 0.0, 0.0) for _ in range(0)]
    closed1, closed2 = 0, 0
    for n in range(steps):
        sine = 0.5 * (math.sin(omega * (tau0 + n * h)) + math.sin(omega * (tau0 + (n + 1) * h)))
        r1 = f1 * sine - k11 * (x1 + g * v1) - k12 * (x2 + g * v2) - c11 * v1 - c12 * v2
        r2 = f2 * sine - k12 * (x1 + g * v1) - k22 * (x2 + g * v2) - c12 * v1 - c22 * v2
        u1, u2 = v1 + h * (n11 * r1 + n12 * r2), v2 + h * (n12 * r1 + n22 * r2)
        wall1, wall2 = _closed(x1 - y1, v1 - w1, g), _closed(x2 - y2, v2 - w2, g)
        before1, before2 = wall1 * (v1 - w1), wall2 * (v2 - w2)
        excess1 = wall1 * (u1 - w1) + kappa * before1 if wall1 != 0 else -math.inf
        excess2 = wall2 * (u2 - w2) + kappa * before2 if wall2 != 0 else -math.inf
        coupling = wall1 * wall2 * n12
        p1, p2 = _impulses(excess1, excess2, n11 + 1.0 / epsilon, coupling, n22 + 1.0 / epsilon)
        u1, u2 = u1 - n11 * wall1 * p1 - n12 * wall2 * p2, u2 - n12 * wall1 * p1 - n22 * wall2 * p2
        b1, b2 = w1 + wall1 * p1 / epsilon, w2 + wall2 * p2 / epsilon
        x1, x2, y1, y2 = x1 + g * (v1 + u1), x2 + g * (v2 + u2), y1 + g * (w1 + b1), y2 + g * (w2 + b2)
        v1, v2, w1, w2 = u1, u2, b1, b2
        if p1 > 0.0 and closed1 == 0:
            rows.append((tau0 + (n + 0.5) * h, 1.0, float(wall1), before1))
        if p2 > 0.0 and closed2 == 0:
            rows.append((tau0 + (n + 0.5) * h, 2.0, float(wall2), before2))
        closed1, closed2 = (1 if p1 > 0.0 else 0), (1 if p2 > 0.0 else 0)
    return np.array([x1, y1, x2, y2, v1, w1, v2, w2]), rows


@disk_cached()
def _closed(gap, speed, g):
    """Return the wall (+1 or -1) that a ball reaches within the time g at constant speed, or 0 for no wall.

    gap: relative displacement W. speed: relative velocity W'.
    """
    ahead = gap + g * speed
    return 1 if ahead >= 1.0 else (-1 if ahead <= -1.0 else 0)


@disk_cached()
def _impulses(q1, q2, d11, d12, d22):
    """Return the impulses P on the two balls, which satisfy P >= 0, D P - q >= 0 and P (D P - q) = 0.

    q has the components q1 and q2; q is -inf for a ball without contact. The matrix D is symmetric and positive
    definite, with the elements d11, d12 and d22.
    """
    if q1 <= 0.0 and q2 <= 0.0:
        return 0.0, 0.0
    if q1 > -math.inf and q2 > -math.inf:
        determinant = d11 * d22 - d12 * d12
        p1, p2 = (d22 * q1 - d12 * q2) / determinant, (d11 * q2 - d12 * q1) / determinant
        if p1 > 0.0 and p2 > 0.0:
            return p1, p2
    if q1 > 0.0 and q2 - d12 * q1 / d11 <= 0.0:
        return q1 / d11, 0.0
    return 0.0, q2 / d22
