"""The tables that the stability figures read, made anew."""

import pandas as pd

import vibroimpact as vi
from vibroimpact.accuracy.verdict_table import fixed_point_rows, orbit_rows
from vibroimpact.exact.orbits.search import orbits


def verdicts_of(systems):
    """Rows of fixed points, and of exact orbits, of all systems (by case)."""
    exact = {case: orbit_rows(case, orbits(system)) for case, system in systems.items()}
    points = []
    for case, system in systems.items():
        listed = vi.fixed_points(system)
        points.append(fixed_point_rows(case, system, listed, exact[case]))
    return pd.concat(points, ignore_index=True), pd.concat(exact.values(), ignore_index=True)
