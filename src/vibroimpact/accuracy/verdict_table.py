"""Tabulate the verdicts of all criteria in CRITERIA on the fixed points and orbits of a case."""

import numpy as np

from vibroimpact.exact.orbits.floquet import floquet
from vibroimpact.exact.orbits.search import COLUMNS
from vibroimpact.system.extras import need
from vibroimpact.theory import criteria
from vibroimpact.theory.criteria import EXACT
from vibroimpact.theory.manifold import stays_within_walls

need("figures", "pandas")

import pandas as pd  # noqa: E402 (after the dependency check)

CRITERIA = (*criteria.CRITERIA, EXACT)
NUMBERS = [name for name in COLUMNS if name not in (EXACT, "proved")]
PROOF = "box_radius", "orbit_error", "moduli_error", "motion_proved", "floquet_proved"
"""Columns of `OrbitProof.row`; a table without rows has them as well."""
NO_ORBIT = "no orbit"
REACH = 1.0
"""Upper limit of the distance in C between a fixed point and its orbit. Over the verdict grid of the studies, at
epsilon = 0.1, it is at most 0.29, or above 2.5 where the orbits next to two fixed points have merged."""


def orbit_rows(case: str, orbits) -> pd.DataFrame:
    """Return one row per orbit with the verdict of each criterion.

    Symmetric orbits have the labels S1, S2, ..., and asymmetric orbits have the labels A1, A2, ... If an orbit has a
    proof, the table also has the columns of `OrbitProof.row`.
    """
    counts, rows = {True: 0, False: 0}, []
    for orbit in orbits:
        counts[orbit.symmetric] += 1
        label = f"{'S' if orbit.symmetric else 'A'}{counts[orbit.symmetric]}"
        row, verdicts = orbit.row(), criteria.of_orbit(orbit) | {EXACT: floquet(orbit)}
        proof = orbit.proof.row() if orbit.proof else {}
        rows.append({"case": case, "label": label} | {name: row[name] for name in NUMBERS} | verdicts | proof)
    return pd.DataFrame(rows, columns=None if rows else ["case", "label", *NUMBERS, *CRITERIA, *PROOF])


def fixed_point_rows(case: str, system, points, orbits: pd.DataFrame) -> pd.DataFrame:
    """Return one row per fixed point, sorted by label, with the verdict of each criterion.

    The column `admissible` is True if the balls stay between the walls at leading order. The column `orbit` contains
    the label of the exact orbit next to the point, or "" if there is no such orbit.

    orbits: result of `orbit_rows` for the case.
    """
    points = sorted(points, key=lambda point: point.label)
    symmetric = orbits[orbits["symmetric"].astype(bool)]  # in an empty table this column is not boolean
    found = partners([point.C for point in points], symmetric[["C1", "C2"]].to_numpy(float))
    rows = []
    for point, place in zip(points, found, strict=True):
        partner = None if place is None else symmetric.iloc[place]
        orbit, exact = ("", NO_ORBIT) if partner is None else (partner["label"], partner[EXACT])
        within = all(stays_within_walls(C, system.kappa) for C in point.C if np.isfinite(C))
        row = {"case": case, "label": point.label, "admissible": within, "C1": point.C[0], "C2": point.C[1]}
        rows.append(row | {"orbit": orbit} | criteria.of_fixed_point(system, point) | {EXACT: exact})
    columns = ["case", "label", "admissible", "C1", "C2", "orbit", *CRITERIA]
    return pd.DataFrame(rows, columns=columns)


def partners(points, orbits) -> list[int | None]:
    """Return, for each fixed point, the index of the exact orbit next to the point, or None if there is none.

    An orbit is next to a point if the orbit is nearest to the point, the point is nearest to the orbit, and their
    distance is below REACH.

    points: amplitudes C of the fixed points, shape (n, 2).
    orbits: amplitudes C of the orbits, shape (m, 2).
    """
    points, orbits = np.reshape(points, (-1, 2)), np.reshape(orbits, (-1, 2))
    if not len(orbits):
        return [None] * len(points)
    gaps = np.linalg.norm(np.nan_to_num(points[:, None] - orbits[None]), axis=2)
    nearest = enumerate(gaps.argmin(axis=1))
    return [int(k) if gaps[:, k].argmin() == n and gaps[n, k] < REACH else None for n, k in nearest]
