"""Compute the decay time after an impulse on a system with balls, and the impulse with the shortest decay."""

import math

import numpy as np
from scipy.linalg import expm
from scipy.optimize import brentq, minimize_scalar

from vibroimpact.exact.engine.simulation import simulate
from vibroimpact.exact.engine.variation import AFTER, BEFORE, COLUMNS, LENGTH, WALLS
from vibroimpact.studies.absorbers.linear import checked_fraction
from vibroimpact.system import System
from vibroimpact.system.arguments import instance, real, whole
from vibroimpact.system.matrices import rate_matrix
from vibroimpact.system.stored_energy import stored

CYCLES_PER_RUN = 50
"""Number of cycles in each simulation, after which the energy is checked."""
SEARCH_FACTOR, SUBDIVISIONS, REFINED_MINIMA = 1.2, 48, 8
"""Settings of `quickest_decay`. In the range of impulses whose decay times are up to SEARCH_FACTOR times the shortest,
the grid of impulses is made SUBDIVISIONS times finer. Then the REFINED_MINIMA lowest minima on the grid are refined."""


def decay_time(system: System, impulse: float, module: int = 1, fraction: float = 0.1, cycles: int = 10_000) -> float:
    """Return the time tau from an impulse on a box until only a fraction of the initial energy is left.

    The forces are set to zero. The system is at rest before the impulse, the balls in the middle of their boxes. The
    energy decreases monotonically, so that it falls to `fraction` of its initial value once. If this happens between
    impacts, the time is the root of a function in closed form; else it is the time of an impact.

    Parameters
    ----------
    system : System
        Dimensionless parameters.
    impulse : float
        Velocity of the box (of mass 1) after the impulse, in units of L omega_10.
    module : int, default 1
        Module of the box, 1 or 2.
    fraction : float, default 0.1
        Fraction of the initial energy, between 0 and 1.
    cycles : int, default 10000
        Largest number of forcing periods that are simulated.

    Returns
    -------
    float
        Time tau, dimensionless; inf if it exceeds `cycles` forcing periods.

    Raises
    ------
    ValueError
        If an argument is malformed.
    ArithmeticError
        As for `simulate`, if a run fails.

    Examples
    --------
    >>> vi.decay_time(system, impulse=1.0)  # doctest: +SKIP
    """
    free = instance("system", system, System).with_(f10_hat=0.0, f20_hat=0.0)
    state, impulse, start = np.zeros(8), real("impulse", impulse), 0.0
    state[2 + 2 * whole("module", module, 1, 2)] = impulse
    target = checked_fraction(fraction) * 0.5 * impulse**2
    if not target > 0:
        raise ValueError(f"impulse: {impulse} gives the system no energy; expected a larger velocity of the box")
    cycles = whole("cycles", cycles, 1, 10**6)
    for done in range(0, cycles, CYCLES_PER_RUN):
        run = simulate(free, state, min(CYCLES_PER_RUN, cycles - done), start)
        flights = run.trajectory[1]
        below = np.flatnonzero(_energies(free, flights[:, AFTER:COLUMNS]) <= target)
        if len(below):
            n = int(below[0])
            return run.tau0 + float(flights[:n, LENGTH].sum()) + _time_within(free, flights[n], target)
        state, start = run.final, run.end
    return math.inf


def quickest_decay(system: System, impulses, times, module: int = 1, fraction: float = 0.1) -> tuple[float, float]:
    """Return the impulse after which the energy falls to a fraction soonest, and the time that this takes.

    As a function of the impulse, the decay time jumps where an impact appears or vanishes, and has many minima between
    the jumps. The search compares impulses on a grid (see `SUBDIVISIONS`); it may miss a minimum that is narrower than
    the spacing of this grid.

    Parameters
    ----------
    system, module, fraction
        As for `decay_time`.
    impulses
        Ascending impulses between which to search, shape (n,).
    times
        Results of `decay_time` for `impulses`, shape (n,).

    Raises
    ------
    ArithmeticError
        As for `decay_time`.
    """

    def time(logarithm):
        return decay_time(system, math.exp(logarithm), module, fraction)

    places, times = np.log(impulses), np.asarray(times)
    near = np.flatnonzero(times <= SEARCH_FACTOR * times.min())
    finer = [
        np.linspace(*places[k : k + 2], SUBDIVISIONS, endpoint=False)[1:]
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
    for k in lowest[np.argsort(taken[lowest], kind="stable")][:REFINED_MINIMA]:
        ends = tried[max(k - 1, 0)], tried[min(k + 1, len(tried) - 1)]
        found = minimize_scalar(time, bounds=ends, method="bounded", options={"xatol": 1e-7})
        best = min(best, (found.fun, found.x))
    return math.exp(best[1]), float(best[0])


def _energies(system, states):
    """Return the stored energy of `states`, (..., 8), whose first four components belong to the boxes."""
    values = np.moveaxis(states, -1, 0)
    return stored(system.stiffness2, system.alpha12, system.epsilon, values[:4], values[4:])


def _time_within(system, flight, target):
    """Return the time from the start of `flight` until the energy has fallen to `target`."""
    stuck = flight[WALLS : WALLS + 2] != 0
    rate, boxes, balls = rate_matrix(system, stuck)[:4, :4], flight[BEFORE : BEFORE + 4], flight[BEFORE + 4 : AFTER]

    def excess(t):
        later = expm(rate * t) @ boxes
        speeds = np.where(stuck, later[2:], balls[2:])
        return stored(system.stiffness2, system.alpha12, system.epsilon, later, [0.0, 0.0, *speeds]) - target

    if _energies(system, flight[BEFORE:AFTER]) <= target:  # the target is reached at the impact before the flight
        return 0.0
    if excess(flight[LENGTH]) > 0:  # the target is reached at the end of the flight, within rounding
        return float(flight[LENGTH])
    return brentq(excess, 0.0, float(flight[LENGTH]))
