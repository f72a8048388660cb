"""Semi-implicit Euler method: a step updates velocities, then positions; impacts are processed at the end of a step."""

import numpy as np
from numba import njit

from vibroimpact.integrators.protocol import UNFINISHED, Method, MethodRun, failed
from vibroimpact.integrators.right_hand_side import accelerations, coefficients


class SymplecticEuler(Method):
    """Semi-implicit Euler method. The setting of a run is the number of steps per cycle."""

    name, family, knob, order = "symplectic Euler", "time-stepping", "steps per cycle", 1
    settings = (300, 1_000, 3_000, 10_000, 30_000)
    careful = 30_000
    limit = 1_000_000_000

    def run(self, system, state, cycles, tau0, setting):
        steps = setting * cycles
        if steps > self.limit:
            return failed(UNFINISHED, f"{steps} steps", 0)
        final, rows = _march(coefficients(system), np.array(state, float), tau0, system.period / setting, steps)
        return MethodRun(final, rows, steps)


@njit(cache=True)
def _march(q, s, tau0, h, steps):
    """Return the state after `steps` steps of length h, and one row [time, module, wall, speed] per impact.

    q: result of `coefficients`. s: initial state, shape (8,); it is overwritten. tau0: initial time.
    """
    epsilon, kappa = q[9], q[10]
    rows = [(0.0, 0.0, 0.0, 0.0) for _ in range(0)]
    for n in range(steps):
        a1, a2 = accelerations(np.sin(q[8] * (tau0 + n * h)), s, q, (0.0, 0.0))
        s[4] += h * a1
        s[6] += h * a2
        s[:4] += h * s[4:]
        for x in (0, 2):
            gap, speed = s[x] - s[x + 1], s[x + 4] - s[x + 5]
            if abs(gap) >= 1.0 and gap * speed > 0.0:
                jump = (1.0 + kappa) * speed / (1.0 + epsilon)
                s[x + 4] -= epsilon * jump
                s[x + 5] += jump
                rows.append((tau0 + (n + 1) * h, 1.0 + x // 2, np.sign(gap), abs(speed)))
    return s, rows
