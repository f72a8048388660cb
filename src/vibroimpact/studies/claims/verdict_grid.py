"""Tabulate verdicts on fixed points over a grid of forces: by the theory, and by exact orbits at several epsilon."""

from itertools import product

import pandas as pd

from vibroimpact.accuracy.verdict_table import NO_ORBIT, partners
from vibroimpact.exact.orbits.floquet import floquet
from vibroimpact.exact.orbits.search import symmetric_orbit
from vibroimpact.exact.orbits.symmetric import symmetric_solutions, symmetric_solutions_under
from vibroimpact.studies.regimes.midpoint_grid import centres
from vibroimpact.theory import criteria
from vibroimpact.theory.criteria import EXACT
from vibroimpact.theory.fixed_points.symmetric_points import fixed_points

NO_MOTION = {"admissible": False, EXACT: NO_ORBIT}


def compute(system, f10_range, f20_range, points: int, epsilon: list[float]) -> pd.DataFrame:
    """Return a table with one row for each fixed point and each epsilon, over a grid of forces.

    The grid consists of the centres of `points` x `points` cells. The column "admissible" is True if the balls stay
    between the walls on the exact orbit. The column "exact" is the verdict on this orbit, or "no orbit".
    """
    forces = list(product(centres(f10_range, points), centres(f20_range, points)))
    plane = [system.with_(f10_hat=f10, f20_hat=f20) for f10, f20 in forces]
    theory = [[(point, criteria.of_fixed_point(here, point)) for point in fixed_points(here)] for here in plane]
    rows = []
    for value in epsilon:
        roots = symmetric_solutions_under(system.with_(epsilon=value), forces)
        for here, judged, there in zip(plane, theory, roots, strict=True):
            orbits = exact_orbits(here.with_(epsilon=value), [point.C for point, _ in judged], there)
            place = {"epsilon": value, "f10_hat": here.f10_hat, "f20_hat": here.f20_hat}
            for (point, verdicts), orbit in zip(judged, orbits, strict=True):
                exact = NO_MOTION if orbit is None else {"admissible": orbit.admissible, EXACT: floquet(orbit)}
                rows.append({**place, "C1": point.C[0], "C2": point.C[1], **verdicts, **exact})
    columns = ["epsilon", "f10_hat", "f20_hat", "C1", "C2", *criteria.CRITERIA, *NO_MOTION]
    return pd.DataFrame(rows, columns=columns).sort_values(columns[:5], ignore_index=True)


def by_epsilon(system, epsilon: list[float]) -> pd.DataFrame:
    """Return a table with a row for each epsilon and each fixed point of a system.

    The column "exact" is the verdict on the exact orbit of the fixed point, or "no orbit". The column "multiplier" is
    the largest modulus of the multipliers of this orbit.
    """
    points, rows = fixed_points(system), []
    for value in epsilon:
        here = system.with_(epsilon=value)
        orbits = exact_orbits(here, [point.C for point in points], symmetric_solutions(here))
        for point, orbit in zip(points, orbits, strict=True):
            place = {"epsilon": value, "label": point.label, "C1": point.C[0], "C2": point.C[1]}
            exact, largest = (NO_ORBIT, None) if orbit is None else (floquet(orbit), abs(orbit.multipliers[0]))
            rows.append(place | criteria.of_fixed_point(system, point) | {EXACT: exact, "multiplier": largest})
    columns = ["epsilon", "label", "C1", "C2", *criteria.CRITERIA, EXACT, "multiplier"]
    return pd.DataFrame(rows, columns=columns)


def exact_orbits(system, points, roots):
    """Yield the exact symmetric Orbit of each fixed point, or None for a fixed point without an orbit.

    points: amplitudes C of the fixed points, shape (n, 2).
    roots: all symmetric orbits, as returned by `symmetric_solutions`.
    """
    for partner in partners(points, roots[:, 2:]):
        yield None if partner is None else symmetric_orbit(system, roots[partner])
