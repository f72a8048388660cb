"""Free decay with balls: the time after an impulse, and the impulse after which it is shortest."""

import math

import numpy as np
from scipy.linalg import expm
from scipy.optimize import brentq, minimize_scalar

from vibroimpact.exact.engine.replay import AFTER, BEFORE, COLUMNS, LENGTH, WALLS
from vibroimpact.exact.engine.simulation import simulate
from vibroimpact.studies.absorbers.linear import checked_fraction
from vibroimpact.system import System
from vibroimpact.system.arguments import instance, real, whole
from vibroimpact.system.matrices import rate_matrix
from vibroimpact.system.stored_energy import stored

AT_ONCE = 50
"""Cycles that are simulated before looking."""
NEARLY, FINER, REFINED = 1.2, 48, 8
"""The quickest decay is looked for from the first to the last impulse after which it takes so many times the least time
at most, at so many times as many impulses; so many of the least times found there are followed to their minimum."""


def decay_time(system: System, impulse: float, module: int = 1, fraction: float = 0.1, cycles: int = 10_000) -> float:
    """Return the time tau after an impulse on a box, until a fraction of the energy is left; the forces are left out.

    Before, all is at rest, the balls in the middle of their boxes. Without force energy only falls, so it passes the
    fraction once, in a flight (the root is found on its closed form) or in an impact.

    Parameters
    ----------
    impulse : float
        Velocity that it gives to the box (of mass 1), dimensionless: in units of L omega_10.
    module : int, default 1
        1 or 2.
    fraction : float, default 0.1
        Between 0 and 1, of the energy at the start.
    cycles : int, default 10000
        Forcing periods after which the search is given up; then the time is inf.

    Raises
    ------
    ValueError
        If an argument is malformed.
    ArithmeticError
        As `simulate`.
    """
    free = instance("system", system, System).with_(f10_hat=0.0, f20_hat=0.0)
    state, impulse, start = np.zeros(8), real("impulse", impulse), 0.0
    state[2 + 2 * whole("module", module, 1, 2)] = impulse
    target = checked_fraction(fraction) * 0.5 * impulse**2
    if not target > 0:
        raise ValueError(f"impulse: {impulse} gives no energy that could decay")
    cycles = whole("cycles", cycles, 1, 10**6)
    for done in range(0, cycles, AT_ONCE):
        run = simulate(free, state, min(AT_ONCE, cycles - done), start)
        flights = run.trajectory[1]
        below = np.flatnonzero(_energies(free, flights[:, AFTER:COLUMNS]) <= target)
        if len(below):
            n = int(below[0])
            return run.tau0 + float(flights[:n, LENGTH].sum()) + _time_within(free, flights[n], target)
        state, start = run.final, run.end
    return math.inf


def quickest_decay(system: System, impulses, times, module: int = 1, fraction: float = 0.1) -> tuple[float, float]:
    """Return the impulse after which a fraction of the energy is left soonest, and the time that it takes.

    The time jumps where an impact comes or goes, and has many minima in between. The search is as fine as `FINER` says:
    what is quicker over a narrower range of impulses is not seen.

    Parameters
    ----------
    system, module, fraction
        As for `decay_time`.
    impulses
        (n,) ascending, to look between.
    times
        (n,) those of `decay_time` after them.

    Raises
    ------
    ArithmeticError
        As `decay_time`.
    """

    def time(logarithm):
        return decay_time(system, math.exp(logarithm), module, fraction)

    places, times = np.log(impulses), np.asarray(times)
    near = np.flatnonzero(times <= NEARLY * times.min())
    finer = [
        np.linspace(*places[k : k + 2], FINER, endpoint=False)[1:]
        for k in range(max(near[0] - 1, 0), min(near[-1] + 1, len(places) - 1))
    ]
    finer = np.concatenate(finer or [[]])
    tried = np.concatenate([places, finer])
    taken = np.concatenate([times, [time(place) for place in finer]])
    order = np.argsort(tried)
    tried, taken = tried[order], taken[order]
    around = np.concatenate([[np.inf], taken, [np.inf]])
    lowest = np.flatnonzero((taken <= around[:-2]) & (taken <= around[2:]))
    best = taken.min(), tried[taken.argmin()]
    for k in lowest[np.argsort(taken[lowest], kind="stable")][:REFINED]:
        ends = tried[max(k - 1, 0)], tried[min(k + 1, len(tried) - 1)]
        found = minimize_scalar(time, bounds=ends, method="bounded", options={"xatol": 1e-7})
        best = min(best, (found.fun, found.x))
    return math.exp(best[1]), float(best[0])


def _energies(system, states):
    """Return the stored energy of states (..., 8), [boxes, balls]."""
    values = np.moveaxis(states, -1, 0)
    return stored(system.stiffness2, system.alpha12, system.epsilon, values[:4], values[4:])


def _time_within(system, flight, target):
    """Return the time in a flight at which the energy falls to the target; 0 if it starts there."""
    stuck = flight[WALLS : WALLS + 2] != 0
    rate, boxes, balls = rate_matrix(system, stuck)[:4, :4], flight[BEFORE : BEFORE + 4], flight[BEFORE + 4 : AFTER]

    def excess(t):
        later = expm(rate * t) @ boxes
        speeds = np.where(stuck, later[2:], balls[2:])
        return stored(system.stiffness2, system.alpha12, system.epsilon, later, [0.0, 0.0, *speeds]) - target

    if _energies(system, flight[BEFORE:AFTER]) <= target:  # in the impact before
        return 0.0
    if excess(flight[LENGTH]) > 0:  # within rounding of the end
        return float(flight[LENGTH])
    return brentq(excess, 0.0, float(flight[LENGTH]))
