"""Integrate with compliant walls (contact_laws), by the method of Dormand and Prince (1980).

The method is explicit. An implicit method could not take longer steps, since its steps must also resolve the
oscillation of a contact.
"""

import math

import numpy as np
from scipy.integrate import RK45

from vibroimpact.exact.engine.compiled import disk_cached
from vibroimpact.integrators.contact_laws import (
    HERTZ,
    HUNT_CROSSLEY,
    SPRING,
    Law,
    damping_of,
    power_law,
    stiffness_of,
    stiffness_turning_at_the_wall,
)
from vibroimpact.integrators.protocol import UNFINISHED, Method, MethodRun, failed
from vibroimpact.integrators.right_hand_side import accelerations, coefficients

RELATIVE, ABSOLUTE = 1e-9, 1e-12
SLOWEST = 1e-3
"""Contacts slower than this speed V have the damping of a contact at V, since damping proportional to 1 / V has no
limit at V = 0."""
SLOWEST_COUNTED = 0.01
"""For a law without walls: lowest speed of a ball at W = 0 for which an impact is counted."""
HALVINGS = 40  # largest number of bisections to locate the beginning of a contact within a step
_STAGES = np.array(RK45.A), np.array(RK45.B), np.array(RK45.C), np.array(RK45.E)


class Penalty(Method):
    """Integration with compliant walls; the setting is the duration of a contact [forcing periods].

    A contact has this duration if it is undamped and begins with the speed 1.
    """

    family, knob, order = "compliant contact", "contact duration", 1
    settings = (1e-1, 3e-2, 1e-2, 3e-3, 1e-3, 3e-4, 1e-4, 3e-5, 1e-5)
    careful = 1e-5
    limit = 10_000_000

    def __init__(self, name: str, law: Law):
        self.name, self._law = name, law

    def run(self, system, state, cycles, tau0, setting):
        law, end, start = self.law(system, setting), tau0 + cycles * system.period, np.array(state, dtype=float)
        final, rows, steps, tau = _march(coefficients(system), law, _STAGES, start, tau0, end, self.limit)
        if tau < end:
            return failed(UNFINISHED, f"{steps} steps reach tau = {tau:.6g}", steps, 6 * steps, rows)
        return MethodRun(final, rows, steps, 6 * steps)

    def law(self, system, setting) -> np.ndarray:
        """Return the numbers of the contact law at this setting, as returned by `law_numbers`."""
        mass = system.epsilon / (1.0 + system.epsilon)
        stiffness = stiffness_of(self._law, mass, setting * system.period)
        return law_numbers(self._law, stiffness, damping_of(self._law, mass, system.kappa, stiffness), 1.0)

    def scale(self, setting, run):
        return setting


class PowerLaw(Penalty):
    """Integration with a spring force K W^(2n - 1) instead of walls; the setting is n.

    K is chosen so that a ball with relative speed 1 at W = 0 reverses its relative motion at W = 1.
    """

    knob = "exponent"
    settings = (10, 30, 100, 300, 1_000, 3_000, 10_000)
    careful = 10_000

    def law(self, system, setting):
        law, mass = self._law(setting), system.epsilon / (1.0 + system.epsilon)
        stiffness = stiffness_turning_at_the_wall(law, mass, system.kappa)
        damping, contact = damping_of(law, mass, system.kappa, stiffness), SLOWEST_COUNTED ** (1.0 / setting)
        return law_numbers(law, stiffness, damping, contact)

    def scale(self, setting, run):
        return 1.0 / setting


def law_numbers(law: Law, stiffness: float, damping: float, contact: float) -> np.ndarray:
    """Return [n, m, K, D, power, start, contact] of a contact law K p^n + D p^m p', shape (7,).

    n, m: exponents of the depth p in the spring force and in the damping force.
    K: coefficient of the spring force.
    D: coefficient of the damping force in a contact that begins with the speed 1.
    power: exponent of the speed V at the beginning of a contact. The damping coefficient of the contact is D V**-power.
    start: value of |W| at which the depth p is 0.
    contact: value of |W| at which a contact begins.
    """
    # With the damping coefficient D V**-power, the coefficient of restitution is the same at every speed V.
    power = (2.0 * law.damping - law.stiffness + 1.0) / (law.stiffness + 1.0)
    return np.array([law.stiffness, law.damping, stiffness, damping, power, float(law.walls), contact])


METHODS = [
    Penalty("penalty", SPRING),
    Penalty("Hertz", HERTZ),
    Penalty("Hunt-Crossley", HUNT_CROSSLEY),
    PowerLaw("power law", power_law),
]
"""One method for each contact law."""


@disk_cached()
def force(gap, speed, law, damping):
    """Return the contact force on a ball, given W (`gap`), W' (`speed`) and the damping D of the contact."""
    depth = abs(gap) - law[5]
    if depth <= 0.0:
        return 0.0
    outwards = 1.0 if gap > 0.0 else -1.0
    return outwards * law[2] * depth ** law[0] + damping * depth ** law[1] * speed


@disk_cached()
def _rates(tau, s, contact, d):
    """Write the derivative of the state s into d.

    contact: tuple of three arrays: the result of `coefficients`, the result of `law_numbers`, and the damping
        coefficients of the contacts of both balls, shape (2,).
    """
    q, law, dampings = contact
    a = accelerations(math.sin(q[8] * tau), s, q, (0.0, 0.0))
    for i in range(2):
        push = force(s[2 * i] - s[2 * i + 1], s[2 * i + 4] - s[2 * i + 5], law, dampings[i])
        d[2 * i], d[2 * i + 1] = s[2 * i + 4], s[2 * i + 5]
        d[2 * i + 4], d[2 * i + 5] = a[i] - push, push / q[9]


@disk_cached()
def _sum(weights, rates, count, c):
    total = 0.0
    for k in range(count):
        total += weights[k] * rates[k, c]
    return total


@disk_cached()
def _step(stages, tau, s, h, contact):
    """Return the state after a step of length h, and the estimated error divided by the allowed error."""
    A, B, C, E = stages
    rates, ahead, error = np.empty((7, 8)), s.copy(), 0.0
    for k in range(6):
        for c in range(8):
            ahead[c] = s[c] + h * _sum(A[k], rates, k, c)
        _rates(tau + C[k] * h, ahead, contact, rates[k])
    for c in range(8):
        ahead[c] = s[c] + h * _sum(B, rates, 6, c)
    _rates(tau + h, ahead, contact, rates[6])
    for c in range(8):
        allowed = ABSOLUTE + RELATIVE * max(abs(s[c]), abs(ahead[c]))
        error += (h * _sum(E, rates, 7, c) / allowed) ** 2 / 8.0
    return ahead, math.sqrt(error)


@disk_cached()
def _reach(s, i, law):
    """Return |W| of ball i minus the |W| at which a contact begins; this difference is negative in flight."""
    return abs(s[2 * i] - s[2 * i + 1]) - law[6]


@disk_cached()
def _march(q, law, stages, s, tau, end, limit):
    """Integrate to `end` in at most `limit` steps.

    Return the last state, the impacts as rows [tau, module, wall, speed], the number of steps, and the time reached.
    """
    rows = [(0.0, 0.0, 0.0, 0.0) for _ in range(0)]
    touching, dampings = np.zeros(2, np.bool_), np.full(2, law[3])
    contact, h, steps = (q, law, dampings), 0.01 * (end - tau), 0
    while steps < limit:
        for i in range(2):  # a contact always begins at the end of a step
            wall = 1.0 if s[2 * i] > s[2 * i + 1] else -1.0  # the wall nearer to the ball
            speed = wall * (s[2 * i + 4] - s[2 * i + 5])
            if not touching[i] and _reach(s, i, law) >= 0.0:
                touching[i], dampings[i] = True, law[3] * max(speed, SLOWEST) ** -law[4]
                if speed > 0.0:
                    rows.append((tau, i + 1.0, wall, speed))
            elif _reach(s, i, law) < 0.0:
                touching[i] = False
        if tau >= end:
            break
        h = min(h, end - tau)
        ahead, error = _step(stages, tau, s, h, contact)
        steps += 1
        if error <= 1.0:
            taken, ahead = _until_contact(stages, tau, s, h, ahead, contact, touching)
            tau, s = end if taken >= end - tau else tau + taken, ahead
        h *= min(5.0, max(0.2, 0.9 * error**-0.2)) if error > 0.0 else (5.0 if error == 0.0 else 0.2)
    return s, rows, steps, tau


@disk_cached()
def _until_contact(stages, tau, s, h, ahead, contact, touching):
    """Shorten a step so that it ends just after the first contact begins.

    Return the length of the shortened step and the state at its end. A step in which no contact begins is not changed.
    """
    least = 0.0
    for _ in range(HALVINGS):
        if not _begins(ahead, contact[1], touching) or least == h:
            break
        half = 0.5 * (least + h)
        there, _ = _step(stages, tau, s, half, contact)
        if _begins(there, contact[1], touching):
            h, ahead = half, there
        else:
            least = half
    return h, ahead


@disk_cached()
def _begins(s, law, touching):
    return (not touching[0] and _reach(s, 0, law) >= 0.0) or (not touching[1] and _reach(s, 1, law) >= 0.0)
