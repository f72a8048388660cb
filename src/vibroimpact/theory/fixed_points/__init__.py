"""All fixed points of the slow flow: the search, its proof, and what is read off the points."""

from vibroimpact.theory.fixed_points.search import FixedPoint, FixedPointSearch, fixed_points, search

__all__ = ["FixedPoint", "FixedPointSearch", "fixed_points", "search"]
