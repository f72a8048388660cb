"""Tabulate verdicts on all fixed points and orbits of a case: (10.26), fast, slow, theory, exact."""

import numpy as np

from vibroimpact.exact.orbits.floquet import floquet
from vibroimpact.system.extras import need
from vibroimpact.system.state import NAMES
from vibroimpact.theory import criteria
from vibroimpact.theory.criteria import EXACT
from vibroimpact.theory.manifold import stays_within_walls

need("figures", "pandas")

import pandas as pd  # noqa: E402 (after the dependency check)

CRITERIA = (*criteria.CRITERIA, EXACT)
NO_ORBIT = "no orbit"
REACH = 1.0
"""Largest distance in C between a fixed point and its orbit. Over the grid of forces at epsilon = 0.1 the distances are
at most 0.29, or above 2.5 where the orbits next to two fixed points have merged."""
_SIDES = [f"{module}_{wall}" for module in (1, 2) for wall in ("plus", "minus")]
_NUMBERS = [*(f"phase{side}" for side in _SIDES), *(f"speed{side}" for side in _SIDES)]
_NUMBERS += [*(f"modulus_{k}" for k in range(1, 9)), *NAMES, "residual"]
_OF_ORBIT = ["case", "label", "symmetric", "admissible", "C1", "C2", *_NUMBERS, *CRITERIA]


def orbit_rows(case: str, orbits) -> pd.DataFrame:
    """Return a row per exact orbit, in order: its numbers and the verdict of each criterion.

    Columns case, label ("S1", ... symmetric, "A1", ... asymmetric), symmetric, admissible, C1, C2 (amplitudes
    of the saw-tooth), phase1_plus, ... (impacts at wall +1 and -1 of each module, in periods), speed1_plus, ...
    (of the flight that starts there), modulus_1 to modulus_8 of the multipliers, descending, the state at tau = 0,
    residual, one column per criterion. For a single machine, entries of the other module and modulus_5 to modulus_8 are
    NaN.
    """
    counts = {True: 0, False: 0}
    rows = []
    for orbit in orbits:
        counts[orbit.symmetric] += 1
        label = f"{'S' if orbit.symmetric else 'A'}{counts[orbit.symmetric]}"
        verdicts = {**criteria.of_orbit(orbit), EXACT: floquet(orbit)}
        kind = [case, label, orbit.symmetric, orbit.admissible]
        numbers = [*orbit.C, *orbit.impact_phases.ravel(), *orbit.ball_speeds.ravel()]
        moduli = np.full(8, np.nan)
        moduli[: len(orbit.multipliers)] = np.abs(orbit.multipliers)
        numbers += [*moduli, *orbit.state]
        rows.append([*kind, *numbers, orbit.residual, *(verdicts[criterion] for criterion in CRITERIA)])
    return pd.DataFrame(rows, columns=_OF_ORBIT)


def fixed_point_rows(case: str, system, labelled, orbits: pd.DataFrame) -> pd.DataFrame:
    """Return a row per fixed point, by label, with the verdicts of the criteria.

    The multipliers are those of its exact orbit.

    Parameters
    ----------
    labelled
        Pairs (label, fixed point).
    orbits : DataFrame
        `orbit_rows` of the same case.

    Columns case, label, admissible (W stays between the walls at leading order), C1, C2, orbit (label of the symmetric
    orbit that goes with it, see `partners`; "" if there is none), one per criterion.
    """
    labelled = sorted(labelled, key=lambda pair: pair[0])
    symmetric = orbits[orbits["symmetric"].astype(bool)]  # an empty table has no types
    found = partners([point.C for _, point in labelled], symmetric[["C1", "C2"]].to_numpy(float))
    rows = []
    for (label, point), place in zip(labelled, found, strict=True):
        partner = None if place is None else symmetric.iloc[place]
        exact = NO_ORBIT if partner is None else partner[EXACT]
        within = all(stays_within_walls(C, system.kappa) for C in point.C if np.isfinite(C))
        verdicts = {**criteria.of_fixed_point(system, point), EXACT: exact}
        orbit = "" if partner is None else partner["label"]
        row = {"case": case, "label": label, "admissible": within, "C1": point.C[0], "C2": point.C[1]}
        rows.append({**row, "orbit": orbit, **verdicts})
    columns = ["case", "label", "admissible", "C1", "C2", "orbit", *CRITERIA]
    return pd.DataFrame(rows, columns=columns)


def partners(points, orbits) -> list[int | None]:
    """Return, for the C of each fixed point (n, 2), the index of the nearest of the orbits (m, 2), or None.

    C of a module that takes no part is NaN and ignored. The result is None if another fixed point is nearer to that
    orbit, or if no orbit lies within REACH.
    """
    points, orbits = np.reshape(points, (-1, 2)), np.reshape(orbits, (-1, 2))
    if not len(orbits):
        return [None] * len(points)
    gaps = np.linalg.norm(np.nan_to_num(points[:, None] - orbits[None]), axis=2)
    nearest = enumerate(gaps.argmin(axis=1))
    return [int(k) if gaps[:, k].argmin() == n and gaps[n, k] < REACH else None for n, k in nearest]
