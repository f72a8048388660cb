"""Integrate eight runs at a time in the vector lanes of heyoka's batch mode, for timing against `ensemble`.

All lanes share one contact state, so that no ball may come to rest on a wall.
"""

import numpy as np

from vibroimpact.integrators.heyoka_taylor import heyoka, right_hand_side
from vibroimpact.integrators.right_hand_side import NAMES, coefficients
from vibroimpact.system.state import BALLS, BOXES

LANES = 8


class HeyokaBatch:
    """heyoka's batch integrator with a given tolerance and one system per lane.

    The integrator is compiled when the object is created.
    """

    def __init__(self, tolerance: float):
        s, _, equations = right_hand_side([heyoka.par[k] for k in range(len(NAMES))])
        events = [
            heyoka.t_event_batch(s[BOXES[i]] - s[BALLS[i]] - wall, callback=self._impact(i), direction=direction)
            for i in range(2)
            for wall, direction in (
                (1.0, heyoka.event_direction.positive),
                (-1.0, heyoka.event_direction.negative),
            )
        ]
        self._taylor = heyoka.taylor_adaptive_batch(equations, np.zeros((10, LANES)), tol=tolerance, t_events=events)
        self._state = self._taylor.state  # a view of the integrator's memory

    def run(self, systems, states, cycles: int) -> np.ndarray:
        """Return the final states (8, LANES) from initial states (8, LANES) at tau = 0."""
        numbers, periods = np.array([coefficients(system) for system in systems]).T, [one.period for one in systems]
        self._taylor.pars[:] = numbers[: len(self._taylor.pars)]  # only the parameters that the equations use
        self._epsilon, kappa = numbers[NAMES.index("epsilon")], numbers[NAMES.index("kappa")]
        self._bounce = (1.0 + kappa) / (1.0 + self._epsilon)
        self._taylor.set_time(0.0)
        self._state[:8], self._state[8], self._state[9] = states, 0.0, 1.0
        self._taylor.reset_cooldowns()
        self._taylor.propagate_until(cycles * np.array(periods))
        return self._state[:8].copy()

    def _impact(self, i):
        box, ball = 4 + BOXES[i], 4 + BALLS[i]

        def callback(taylor, sign, lane):
            impulse = self._bounce[lane] * (self._state[box, lane] - self._state[ball, lane])
            self._state[box, lane] -= self._epsilon[lane] * impulse
            self._state[ball, lane] += impulse
            return True

        return callback
