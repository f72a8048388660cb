"""Checks of section 10.5 on what it leaves to later work: strong couplings, one-sided impacts, harvesting."""

import numpy as np

from vibroimpact.accuracy.verdict_table import partners
from vibroimpact.exact.orbits.search import symmetric_orbit
from vibroimpact.exact.orbits.symmetric import symmetric_solutions
from vibroimpact.studies.claims.finding import Finding
from vibroimpact.studies.regimes.classification import starts
from vibroimpact.studies.regimes.coupling import coupled, impact_power, leaning_orbits
from vibroimpact.system.verdict import STABLE
from vibroimpact.theory import criteria
from vibroimpact.theory.fixed_points.symmetric_points import fixed_points

CHECKS = ("strong_coupling", "one_sided_impacts", "harvesting")
SETTLED, OBSERVED = 1500, 500
SAME_POWER = 1e-3
"""Largest relative difference of powers of the same motion."""


def errors(system) -> list[dict]:
    """Return a row per fixed point: relative error of C, verdicts of the theory and of the exact orbit.

    error: the largest difference of C_1 or C_2 from that of the exact orbit, over the larger of its C; nan where there
    is none that is a motion. own_error: the same with each difference over its own C. predicted, exact: True if called
    stable on both time scales, and if all multipliers are inside the unit circle. orbits: how many symmetric motions
    there are, the same in all rows.
    """
    points = fixed_points(system)
    found = [symmetric_orbit(system, root) for root in symmetric_solutions(system)]
    places = partners([point.C for point in points], np.array([orbit.C for orbit in found]).reshape(-1, 2))
    motions, rows = sum(orbit.admissible for orbit in found), []
    for point, place in zip(points, places, strict=True):
        orbit = None if place is None else found[place]
        moves = orbit is not None and orbit.admissible
        C = orbit.C if moves else np.full(2, np.nan)
        apart = np.abs(point.C - C)
        predicted = criteria.of_fixed_point(system, point)[criteria.THEORY] == STABLE
        of_point = {"error": float(apart.max() / C.max()), "own_error": float((apart / C).max())}
        stable = moves and orbit.stability == STABLE
        rows.append(of_point | {"predicted": predicted, "exact": stable, "orbits": motions})
    return rows


def strong_coupling(evidence, case, couplings):
    """Measure the errors of fixed points with a coupling spring stronger than in the case.

    The coupling damper changes in proportion, or stays the same.
    """
    system = evidence.systems[case]
    ours = max(row["error"] for row in errors(system))
    parts, numbers = {}, {"largest error at the coupling of the case": ours}
    for held, name in ((False, "damper in proportion"), (True, "damper held")):
        rows = [row for value in couplings for row in errors(coupled(system, value, held))]
        wrong = sum(row["predicted"] and not row["exact"] for row in rows)
        called = sum(row["predicted"] for row in rows)
        parts[f"{name}: the method fails in amplitude"] = any(not row["error"] <= 2 * ours for row in rows)
        parts[f"{name}: it fails in stability"] = 2 * wrong > called
        numbers |= {f"{name}: points": len(rows), f"{name}: called stable, wrongly": [called, wrong]}
        numbers[f"{name}: without a motion"] = sum(np.isnan(row["error"]) for row in rows)
        numbers[f"{name}: largest error"] = np.nanmax([row["error"] for row in rows])
        numbers[f"{name}: largest error over its own C"] = np.nanmax([row["own_error"] for row in rows])
    return Finding(parts, numbers)


def one_sided_impacts(evidence):
    """Leave the claim open, since with one wall the ball of this model leaves its box forever."""
    return Finding({"one-sided impacts need another model, with a force on the ball": None})


def harvesting(evidence, cases, number, seed):
    """Compare the mean impact power of motions other than 1:1 responses with that of 1:1 responses.

    These are the stable asymmetric response and the symmetric one next to it, or the only symmetric one.
    """
    begun, parts, numbers = starts(number, seed), {}, {}
    for case in cases:
        system = evidence.systems[case]
        taken = impact_power(system, begun, SETTLED + OBSERVED, SETTLED)
        found = [symmetric_orbit(system, root) for root in symmetric_solutions(system)]
        symmetric, leaning = [one for one in found if one.admissible], leaning_orbits(system, both=False)
        C = (leaning or symmetric)[0].C
        known = {"symmetric": min(symmetric, key=lambda one: np.abs(one.C - C).max())}
        known |= {"stable leaning": leaning[0]} if leaning else {}
        powers = {name: float(impact_power(system, [one.state], 1)[0]) for name, one in known.items()}
        others = taken[~np.isclose(taken[:, None], list(powers.values()), rtol=SAME_POWER).any(axis=1)]
        numbers[f"starts that end on no 1:1 response, case {case}"] = len(others)
        for name, power in powers.items() if len(others) else ():
            parts[f"more than the {name} response, case {case}"] = others.mean() > power
            measured = [float(others.mean() / power), float(others.std() / power)]
            numbers[f"over that of the {name} response, case {case}: mean and standard deviation"] = measured
    return Finding(parts, numbers)
