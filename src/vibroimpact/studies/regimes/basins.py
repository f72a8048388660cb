"""Compute the basins of coexisting regimes in a plane of initial states, with both ball positions as coordinates."""

from itertools import product

import numpy as np

from vibroimpact.exact.orbits.search import orbits
from vibroimpact.studies.regimes.classification import ASYMMETRIC
from vibroimpact.studies.regimes.midpoint_grid import centres
from vibroimpact.studies.regimes.settling import Observation, settle

MIRRORED = "asymmetric, mirrored"


def stable_response(system):
    """Return a stable asymmetric orbit, or None if there is none.

    Of several orbits, return the one with the longest flight from wall +1 to wall -1. Only flights of the ball in the
    first active module are compared.
    """
    stable = [o for o in orbits(system) if o.admissible and not o.symmetric and abs(o.multipliers[0]) < 1]
    first = system.modules[0] - 1 if stable else None
    return min(stable, key=lambda orbit: orbit.ball_speeds[first, 0] / orbit.ball_speeds[first].sum(), default=None)


def plane(state, points: int) -> np.ndarray:
    """Return copies of `state` with the balls at the points of a grid, shape (points^2, 8).

    W_1 and W_2 are the midpoints of `points` equal cells of the interval (-1, 1). W_2 varies fastest.
    """
    states = np.tile(np.asarray(state, dtype=float), (points**2, 1))
    states[:, [1, 3]] = states[:, [0, 2]] - list(product(centres((-1.0, 1.0), points), repeat=2))
    return states


def ends(system, states, observation: Observation) -> list[str]:
    """Return the regime in which the motion from each initial state ends.

    If an asymmetric response has a positive `Regime.flight_asymmetry`, its regime is called MIRRORED.
    """
    regimes = settle(system, states, observation)
    return [MIRRORED if one.name == ASYMMETRIC and one.flight_asymmetry > 0 else one.name for one in regimes]
