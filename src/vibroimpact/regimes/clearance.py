"""How near a periodic motion comes to the walls between its impacts."""

import numpy as np

from vibroimpact.exact.orbits.floquet import follow
from vibroimpact.exact.orbits.search import Orbit, extremes

_MODULES = np.array([1, 1, 2, 2])


def largest_excursion(orbit: Orbit) -> float:
    """The largest |W_i| at its extrema between impacts, at a wall 1; 0 if no flight has an extremum."""
    system, period = orbit.system, orbit.system.period
    times = (orbit.impact_phases * period).ravel()
    order = np.argsort(np.where(times == 0, period, times), kind="stable")
    impacts = np.where(times == 0, period, times)[order]
    passage = follow(system, orbit.state, impacts, _MODULES[order], period)
    flights = zip([orbit.state, *passage.after], [0.0, *impacts], [*impacts, period], strict=True)
    return max(extremes(system, *flight).max(initial=0.0) for flight in flights)
