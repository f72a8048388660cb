"""Compute the tables that the stability figures read."""

import pandas as pd

import vibroimpact as vi
from vibroimpact.accuracy.verdict_table import fixed_point_rows, orbit_rows
from vibroimpact.exact.orbits.search import orbits


def verdicts_of(systems):
    """Return the table rows for the fixed points and for the exact orbits of all systems, given by case."""
    exact = {case: orbit_rows(case, orbits(system)) for case, system in systems.items()}
    points = []
    for case, system in systems.items():
        listed = vi.fixed_points(system)
        points.append(fixed_point_rows(case, system, listed, exact[case]))
    return pd.concat(points, ignore_index=True), pd.concat(exact.values(), ignore_index=True)
