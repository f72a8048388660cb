"""Exact 1:1 orbits, two impacts per cycle and module: all of them, with their Floquet multipliers."""

from vibroimpact.exact.orbits.search import Orbit, OrbitSearch, orbits, search

__all__ = ["Orbit", "OrbitSearch", "orbits", "search"]
