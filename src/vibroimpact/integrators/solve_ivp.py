"""Integrate with SciPy's solve_ivp, which stops at each impact and each end of a contact, and is then restarted."""

import numpy as np
from scipy.integrate import solve_ivp

from vibroimpact.integrators.protocol import REFUSED, UNFINISHED, Method, MethodRun, failed
from vibroimpact.integrators.right_hand_side import jacobian, rates
from vibroimpact.integrators.rigid_contact import Contacts, first_sample_time, guard
from vibroimpact.system.state import BALLS, BOXES

ABSOLUTE = 1e-2  # ratio atol / rtol
LOST = "the interpolant of a step misses the impact that the step contains"
PATIENCE = 100  # largest number of successive events without progress in time


class SolveIvp(Method):
    """One method of solve_ivp; the setting is the relative tolerance rtol.

    The first step after an impact is at most half the expected duration of the flight that follows. Therefore no
    impact of a chatter (impacts at one wall in ever shorter flights) is missed.
    """

    family, knob = "solve_ivp", "rtol"

    def __init__(self, integrator: str, settings, careful, order=None, implicit=False):
        self.name, self.settings, self.careful, self.order = integrator, settings, careful, order
        self._implicit = implicit

    def run(self, system, state, cycles, tau0, setting):
        contacts = Contacts(system, slow=setting**0.5)
        tau, end, s = tau0, tau0 + cycles * system.period, np.array(state, dtype=float)
        steps = evaluations = idle = 0
        contacts.start(tau, s)
        while tau < end:
            if steps >= self.limit:
                reason = f"{self.limit} steps reach tau = {tau:.6g}"
                return failed(UNFINISHED, reason, steps, evaluations, contacts.impacts)
            options = {"jac": jacobian(system, [w != 0 for w in contacts.walls])} if self._implicit else {}
            first = first_sample_time(tau, s, contacts.numbers, contacts.walls, np.inf)
            if first < end - tau:
                options["first_step"] = max(first, 1e-14 * (1.0 + abs(tau)))
            try:
                flight = solve_ivp(
                    rates,
                    (tau, end),
                    s,
                    method=self.name,
                    args=(contacts.numbers, contacts.walls),
                    events=[event for i, wall in enumerate(contacts.walls) for event in _events(i, wall)],
                    rtol=setting,
                    atol=ABSOLUTE * setting,
                    **options,
                )
            except ValueError:  # the search of solve_ivp for the time of the event failed
                return failed(REFUSED, f"{LOST} at tau = {tau:.6g}", steps, evaluations, contacts.impacts)
            steps, evaluations = steps + len(flight.t) - 1, evaluations + flight.nfev
            if flight.status < 0:
                reason = f"the step falls below rounding at tau = {flight.t[-1]:.6g}"
                return failed(REFUSED, reason, steps, evaluations, contacts.impacts)
            idle = idle + 1 if flight.t[-1] <= tau else 0
            if idle > PATIENCE:
                return failed(UNFINISHED, f"time stands still at tau = {tau:.6g}", steps, evaluations, contacts.impacts)
            tau, s = float(flight.t[-1]), flight.y[:, -1].copy()
            if flight.status == 1:
                contacts.resolve(tau, s, [k // 2 for k in range(4) if tau in flight.t_events[k]])
        return MethodRun(s, contacts.impacts, steps, evaluations)


def _events(i, wall):
    """Return two functions, at least one of which falls through zero at the next event of module i.

    For a flying ball, the functions are its distances to the two walls. For a sticking ball, both functions are the
    contact force divided by epsilon.
    """
    x, y = BOXES[i], BALLS[i]

    def lower(tau, s, numbers, walls):
        return guard(tau, s, numbers, walls, i) if wall else 1.0 + s[x] - s[y]

    def upper(tau, s, numbers, walls):
        return guard(tau, s, numbers, walls, i) if wall else 1.0 - s[x] + s[y]

    for event in (lower, upper):
        event.terminal, event.direction = True, -1.0
    return [lower, upper]


COARSE, FINE = (1e-3, 1e-4, 1e-5, 1e-6, 1e-7), (1e-8, 1e-9, 1e-10, 1e-11)
METHODS = [
    SolveIvp("RK45", (*COARSE, *FINE), careful=1e-9, order=5),
    SolveIvp("DOP853", (*COARSE[1:], *FINE, 1e-12, 3e-13, 3e-14), careful=1e-12, order=8),
    SolveIvp("Radau", (*COARSE, 1e-8), careful=1e-8, order=5, implicit=True),
    SolveIvp("LSODA", (*COARSE, *FINE), careful=1e-10),
]
"""Explicit, implicit and switching methods."""
