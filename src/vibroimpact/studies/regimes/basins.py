"""Compute basins of coexisting regimes in the plane of both ball positions."""

from itertools import product

import numpy as np

from vibroimpact.exact.orbits.search import orbits
from vibroimpact.studies.regimes.classification import ASYMMETRIC
from vibroimpact.studies.regimes.midpoint_grid import centres
from vibroimpact.studies.regimes.settling import Observation, settle

MIRRORED = "asymmetric, mirrored"


def stable_response(system):
    """Return the stable asymmetric orbit with the longest flight of the first active ball from wall +1, or None."""
    stable = [o for o in orbits(system) if o.admissible and not o.symmetric and abs(o.multipliers[0]) < 1]
    first = system.modules[0] - 1 if stable else None
    return min(stable, key=lambda orbit: orbit.ball_speeds[first, 0] / orbit.ball_speeds[first].sum(), default=None)


def plane(state, points: int) -> np.ndarray:
    """Return `state` with points^2 positions of the balls in -1 < W_i < 1, shape (points^2, 8); W_2 varies fastest."""
    states = np.tile(np.asarray(state, dtype=float), (points**2, 1))
    states[:, [1, 3]] = states[:, [0, 2]] - list(product(centres((-1.0, 1.0), points), repeat=2))
    return states


def ends(system, states, observation: Observation) -> list[str]:
    """Return the regime in which the motion from each initial state ends.

    An asymmetric response with positive `Regime.flight_asymmetry` is called MIRRORED.
    """
    regimes = settle(system, states, observation)
    return [MIRRORED if one.name == ASYMMETRIC and one.flight_asymmetry > 0 else one.name for one in regimes]
