"""Free decay with balls: how long an impulse is felt."""

import math

import numpy as np
from scipy.linalg import expm
from scipy.optimize import brentq

from vibroimpact.absorbers.linear import checked_fraction
from vibroimpact.exact.engine.replay import AFTER, BEFORE, COLUMNS, LENGTH, WALLS
from vibroimpact.exact.engine.simulation import simulate
from vibroimpact.system import System
from vibroimpact.system.arguments import instance, real, whole
from vibroimpact.system.energy import stored
from vibroimpact.system.matrices import rate_matrix

AT_ONCE = 50
"""Cycles that are simulated before looking."""


def decay_time(system: System, impulse: float, module: int = 1, fraction: float = 0.1, cycles: int = 10_000) -> float:
    """Time tau after an impulse on a box, until a fraction of the energy is left; the forces are left out.

    Before, all is at rest, the balls in the middle of their boxes. Without force energy only falls, so it passes the
    fraction once, in a flight (the root is found on its closed form) or in an impact.

    Args:
        impulse: velocity that it gives to the box (of mass 1), dimensionless: in units of L omega_10.
        module: 1 or 2.
        fraction: between 0 and 1, of the energy at the start.
        cycles: forcing periods after which the search is given up; then the time is inf.

    Raises:
        ValueError: an argument is malformed.
        ArithmeticError: as `simulate`.
    """
    free = instance("system", system, System).with_(f10_hat=0.0, f20_hat=0.0)
    state, impulse, begin = np.zeros(8), real("impulse", impulse), 0.0
    state[2 + 2 * whole("module", module, 1, 2)] = impulse
    target = checked_fraction(fraction) * 0.5 * impulse**2
    if not target > 0:
        raise ValueError(f"impulse: {impulse} gives no energy that could decay")
    cycles = whole("cycles", cycles, 1, 10**6)
    for done in range(0, cycles, AT_ONCE):
        run = simulate(free, state, min(AT_ONCE, cycles - done), begin)
        flights = run.course[1]
        below = np.flatnonzero(_energies(free, flights[:, AFTER:COLUMNS]) <= target)
        if len(below):
            n = int(below[0])
            return run.tau0 + float(flights[:n, LENGTH].sum()) + _time_within(free, flights[n], target)
        state, begin = run.final, run.end
    return math.inf


def _energies(system, states):
    """Stored energy of states (..., 8), [boxes, balls]."""
    values = np.moveaxis(states, -1, 0)
    return stored(system.stiffness2, system.alpha12, system.epsilon, values[:4], values[4:])


def _time_within(system, flight, target):
    """When the energy falls to the target in a flight that ends with no more; 0 where it started so."""
    stuck = flight[WALLS : WALLS + 2] != 0
    rate, boxes, balls = rate_matrix(system, stuck)[:4, :4], flight[BEFORE : BEFORE + 4], flight[BEFORE + 4 : AFTER]

    def excess(t):
        later = expm(rate * t) @ boxes
        speeds = np.where(stuck, later[2:], balls[2:])
        return stored(system.stiffness2, system.alpha12, system.epsilon, later, [0.0, 0.0, *speeds]) - target

    if excess(0.0) <= 0 or excess(flight[LENGTH]) > 0:  # in the impact before, or within rounding of the end
        return 0.0 if excess(0.0) <= 0 else float(flight[LENGTH])
    return brentq(excess, 0.0, float(flight[LENGTH]))
