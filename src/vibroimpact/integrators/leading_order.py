"""Use the chapter's leading-order solution, (10.9)-(10.12), as a method that needs no integration and no transient."""

from functools import partial

import numpy as np

from vibroimpact.integrators.protocol import REFUSED, Method, MethodRun, failed
from vibroimpact.system.state import MODULES
from vibroimpact.theory.fixed_points.symmetric_points import fixed_points
from vibroimpact.theory.manifold import impact_phase, rho
from vibroimpact.theory.response import impact_times, leading_order


class LeadingOrder(Method):
    """Leading-order response (error of order epsilon) of the stable fixed point nearest to the initial state."""

    name, family, knob, settings, careful = "leading order", "multiple scales", "order", (0,), 0

    def run(self, system, state, cycles, tau0, setting):
        try:
            points = [point for point in fixed_points(system) if (point.slow_eigenvalues.real < 0).all()]
        except ValueError as error:
            return failed(REFUSED, str(error), 0)
        if not points:
            return failed(REFUSED, "no stable fixed point of the slow flow", 0)
        starts = [np.abs(steady_state(system, point, tau0) - state).max() for point in points]
        point = points[int(np.argmin(starts))]
        end = tau0 + cycles * system.period
        return MethodRun(steady_state(system, point, end), partial(_impacts, system, point, tau0, end), 1)


def steady_state(system, point, tau) -> np.ndarray:
    """Return the leading-order state (8,) at time `tau`; the velocities are the derivatives of the displacements."""
    response = leading_order(system, point, [tau])
    phase = system.Omega * tau - point.psi
    U_rate = system.Omega * point.B * np.cos(phase)
    falling = np.sin(phase - impact_phase(point.C, rho(system.kappa))) >= 0
    W_rate = U_rate + np.where(falling, -1.0, 1.0) * 2.0 / np.pi * point.C * system.Omega
    X_rate = (U_rate + system.epsilon * W_rate) / (1.0 + system.epsilon)
    state = np.empty(8)
    state[0:4:2], state[1:4:2] = response.X[0], response.Y[0]
    state[4::2], state[5::2] = X_rate, X_rate - W_rate
    state[~np.isin(MODULES, system.modules)] = 0.0
    return state


def _impacts(system, point, start, end):
    rows = []
    for module in system.modules:
        first = impact_times(system, point)[module - 1]
        half = 0.5 * system.period
        numbers = np.arange(np.ceil((start - first) / half), np.floor((end - first) / half) + 1)
        speed = 2.0 * (2.0 / np.pi * point.C[module - 1] * system.Omega) / (1.0 + system.kappa)  # (10.14)
        rows += [(first + n * half, module, 1 if n % 2 == 0 else -1, speed) for n in numbers]
    return sorted(rows)
