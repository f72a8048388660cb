"""How near a periodic motion comes to the walls between its impacts."""

from vibroimpact.exact.orbits.search import Orbit, extremes


def largest_excursion(orbit: Orbit) -> float:
    """The largest |W_i| at its extrema between impacts, at a wall 1; 0 if no flight has an extremum."""
    return max(extremes(orbit.system, *flight).max(initial=0.0) for flight in orbit.passage.flights())
