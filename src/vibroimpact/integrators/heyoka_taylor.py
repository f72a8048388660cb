"""Integrate with heyoka's adaptive Taylor method; callbacks of wall events apply the impact law.

Sine and cosine of the forcing phase are two further states. Therefore the Taylor recursion contains no transcendental
functions. This is the fastest use of heyoka that was found.

After an event, heyoka ignores the same event for a short time. This time is called the cooldown. An impact at the end
of a very short flight could therefore be missed. To avoid this, a ball sticks if its rebound is slower than
max(sqrt(tolerance), SLOWEST) and its box presses it against the wall.
"""

from functools import lru_cache

import numpy as np

from vibroimpact.integrators.protocol import REFUSED, UNFINISHED, Method, MethodRun, failed
from vibroimpact.integrators.right_hand_side import NAMES, coefficients
from vibroimpact.integrators.rigid_contact import SLOWEST, Contacts
from vibroimpact.system.state import BALLS, BOXES
from vibroimpact.system.state import NAMES as STATE

try:
    import heyoka
except ImportError as error:  # heyoka has no package for this platform
    heyoka, _missing = None, str(error)


class HeyokaTaylor(Method):
    """heyoka's Taylor integrator; the setting is the tolerance of the Taylor series."""

    name, family, knob = "heyoka", "Taylor", "tolerance"
    careful = float(np.finfo(float).eps)
    settings = (1e-3, 1e-4, 1e-6, 1e-8, 1e-10, 1e-12, 1e-13, 1e-15, careful)
    limit, compiles_settings = 10_000_000, True

    def available(self):
        return None if heyoka else _missing

    def run(self, system, state, cycles, tau0, setting):
        contacts = Contacts(system, slow=max(setting**0.5, SLOWEST))
        tau, end, s = tau0, tau0 + cycles * system.period, np.array(state, dtype=float)
        steps = 0
        contacts.start(tau, s)
        while True:
            integrator = _Integrator(setting, tuple(w != 0 for w in contacts.walls))
            tau, s, taken, module, failure = integrator.propagate(contacts, tau, s, end, self.limit - steps)
            steps += taken
            if failure:
                outcome = UNFINISHED if failure == heyoka.taylor_outcome.step_limit else REFUSED
                return failed(outcome, f"{failure} at tau = {tau:.6g}", steps, noted=contacts.impacts)
            if module is None:
                return MethodRun(s, contacts.impacts, steps)
            contacts.resolve(tau, s, [module])


def _right_hand_side(stuck):
    """Return the state variables, the accelerations of the boxes, and the equations as pairs (variable, derivative)."""
    s, (sine, cosine) = heyoka.make_vars(*STATE), heyoka.make_vars("sine", "cosine")
    q = {name: heyoka.par[k] for k, name in enumerate(NAMES)}
    force = [
        q["f1"] * sine - q["k11"] * s[0] - q["k12"] * s[2] - q["c11"] * s[4] - q["c12"] * s[6],
        q["f2"] * sine - q["k12"] * s[0] - q["k22"] * s[2] - q["c12"] * s[4] - q["c22"] * s[6],
    ]
    acceleration = [f / (1.0 + q["epsilon"]) if held else f for f, held in zip(force, stuck, strict=True)]
    equations = [(s[k], s[4 + k]) for k in range(4)]
    for i in range(2):
        equations.append((s[4 + BOXES[i]], acceleration[i]))
        equations.append((s[4 + BALLS[i]], acceleration[i] if stuck[i] else heyoka.expression(0.0)))
    return s, acceleration, [*equations, (sine, q["omega"] * cosine), (cosine, -q["omega"] * sine)]


@lru_cache(maxsize=64)  # heyoka compiles each integrator when it is created
class _Integrator:
    """heyoka's integrator of (10.2), with event callbacks that apply the impact law.

    An integrator belongs to one contact state. stuck: for each ball, True if it sticks to a wall.
    """

    def __init__(self, tolerance, stuck):
        self.stuck = stuck
        s, acceleration, equations = _right_hand_side(stuck)
        events = [event for i in range(2) for event in self._events(i, s[BOXES[i]] - s[BALLS[i]], acceleration[i])]
        self._taylor = heyoka.taylor_adaptive(equations, [0.0] * 9 + [1.0], tol=tolerance, t_events=events)
        self._state = self._taylor.state  # a view of the integrator's memory

    def propagate(self, contacts, tau, state, end, limit):
        """Integrate to `end` or to an event that stops the flight; return (tau, state, steps, module, failure).

        module: index of the module that stopped the flight, or None. failure: heyoka's outcome if it failed, or None.
        """
        taylor, system = self._taylor, contacts.system
        taylor.pars[:] = coefficients(system)[: len(taylor.pars)]  # only the parameters that the equations use
        taylor.time = tau
        self._state[:8] = state
        self._state[8:] = np.sin(system.Omega * tau), np.cos(system.Omega * tau)
        taylor.reset_cooldowns()
        self._contacts, self._stopped_by = contacts, None
        self._epsilon, self._bounce = system.epsilon, (1.0 + system.kappa) / (1.0 + system.epsilon)
        self._slow = contacts.slow / system.kappa
        outcome, _, _, steps, *_ = taylor.propagate_until(end, max_steps=limit)
        stopped = self._stopped_by is not None or outcome == heyoka.taylor_outcome.time_limit
        return taylor.time, self._state[:8].copy(), steps, self._stopped_by, None if stopped else outcome

    def _events(self, i, gap, acceleration):
        rising, falling = heyoka.event_direction.positive, heyoka.event_direction.negative
        if self.stuck[i]:  # the event is a sign change of the contact force
            return [heyoka.t_event(acceleration, callback=lambda taylor, sign: self._stop(i))]
        return [
            heyoka.t_event(gap - 1.0, callback=self._impact(i, 1), direction=rising),
            heyoka.t_event(gap + 1.0, callback=self._impact(i, -1), direction=falling),
        ]

    def _stop(self, i):
        """Note the module whose event stops the flight; return False, which stops heyoka."""
        self._stopped_by = i
        return False

    def _impact(self, i, wall):
        """Return the callback that applies the impact law to ball i at a wall.

        The callback only stops the flight if one of the two balls sticks, or if ball i is slow enough to stick.
        """
        s_box, s_ball = 4 + BOXES[i], 4 + BALLS[i]

        def callback(taylor, sign):
            s = self._state
            speed = s[s_box] - s[s_ball]
            if abs(speed) <= self._slow or any(self.stuck):
                return self._stop(i)
            impulse = self._bounce * speed
            s[s_box] -= self._epsilon * impulse
            s[s_ball] += impulse
            self._contacts.impacts.append((taylor.time, i + 1, wall, wall * speed))
            return True

        return callback
