"""Compute the data of the interactive pages of the report."""

import json

from vibroimpact.exact.orbits.floquet import floquet
from vibroimpact.exact.orbits.symmetric import symmetric_solutions, symmetric_solutions_under
from vibroimpact.studies.claims.verdict_grid import exact_orbits
from vibroimpact.studies.figures.plotting.regime_colours import COLOURS
from vibroimpact.studies.regimes.classification import CHAOTIC, REGIMES
from vibroimpact.system.chapter import PARAMETERS
from vibroimpact.system.parameters import System
from vibroimpact.system.verdict import STABLE
from vibroimpact.theory.criteria import of_fixed_point
from vibroimpact.theory.fixed_points.symmetric_points import fixed_points
from vibroimpact_pipeline.specs import case_parameters

FORCES = ("f10_hat", "f20_hat")


def live_data(config: dict) -> str:
    """Return the data of the page Play as JSON.

    Cases that differ from the first case in more than the forcing amplitudes are omitted.
    """
    given = {case: case_parameters(config, case) for case in config["cases"]}
    systems = {case: System(**{name: known[name] for name in (*PARAMETERS, *FORCES)}) for case, known in given.items()}
    first, *_ = systems.values()
    cases = {
        name: {"forces": [system.f10_hat, system.f20_hat], "points": _points(system, symmetric_solutions(system))}
        for name, system in systems.items()
        if system == first.with_(f10_hat=system.f10_hat, f20_hat=system.f20_hat)
    }
    return json.dumps({"system": {name: getattr(first, name) for name in PARAMETERS}, "cases": cases})


def _points(system, roots) -> list[dict]:
    """Return the fixed points of a system; `roots` are the symmetric exact orbits of the system.

    The entry of a point contains its label and three values of module 2: the saw-tooth amplitude C, the amplitude B and
    the phase lag psi. The entry also contains the verdict of (10.26) on the point, the verdict on the exact orbit that
    belongs to the point, and the largest modulus of a multiplier of this orbit.
    """
    points = fixed_points(system)
    exact = exact_orbits(system, [point.C for point in points], roots)
    found = [_point(system, point, orbit) for point, orbit in zip(points, exact, strict=True)]
    return sorted(found, key=lambda point: point["label"])


def _point(system, point, orbit) -> dict:
    place = {name: round(float(getattr(point, name)[1]), 4) for name in ("C", "B", "psi")}
    verdicts = {"label": point.label, "printed": of_fixed_point(system, point)["printed_10_26"]}
    if orbit is None:
        return place | verdicts | {"exact": "no exact orbit", "multiplier": ""}
    largest = abs(orbit.multipliers[0])
    shown = f"{largest:.3g}" if largest < 1e3 else f"{largest:.0f}"
    return place | verdicts | {"exact": floquet(orbit), "multiplier": shown}


def map_data(results, config: dict) -> str:
    """Return the data of the regime map on the page Play as JSON.

    If the system of the map differs from that of the first case in more than the forcing amplitudes, return an
    empty text.
    """
    first, *_ = (case_parameters(config, case) for case in config["cases"])
    swept = case_parameters(config, config["sweeps"]["regime_map"]["case"]) if "regime_map" in config["sweeps"] else {}
    if any(swept.get(name) != first[name] for name in PARAMETERS):
        return ""
    table = results.table("sweeps/regime_map.csv")
    system = System(**{name: swept[name] for name in (*PARAMETERS, *FORCES)})
    regimes = table[list(REGIMES)].fillna(0.0).idxmax(axis=1)
    forces = table[list(FORCES)].to_numpy()
    cells = []
    for (f10, f20), regime, roots in zip(forces, regimes, symmetric_solutions_under(system, forces), strict=True):
        points = _points(system.with_(f10_hat=f10, f20_hat=f20), roots)
        cells.append([round(f10, 4), round(f20, 4), regime, points])
    names = {regime: "chaotic, always resonant" if regime == CHAOTIC else regime for regime in dict.fromkeys(regimes)}
    return json.dumps({"cells": cells, "names": names, "colours": {regime: COLOURS[regime] for regime in names}})


def verdict_data(results, config: dict) -> str:
    """Return the data for the slider of epsilon as JSON.

    The data contain a list for each criterion and each epsilon. This list contains the fixed points that the criterion
    classifies as stable. A fixed point is given as [f10, f20, verdict on the exact orbit].
    """
    table, grid = results.table("verdict_grid.csv"), config["stability"]["verdict_grid"]
    by_epsilon = list(table.groupby("epsilon"))[::-1]
    points = {
        criterion: [
            rows.loc[rows[criterion] == STABLE, ["f10_hat", "f20_hat", "exact"]].round(6).to_numpy().tolist()
            for _, rows in by_epsilon
        ]
        for criterion in ("theory", "printed_10_26")
    }
    ends = [min(grid["f10_range"][0], grid["f20_range"][0]), max(grid["f10_range"][1], grid["f20_range"][1])]
    scale = {"epsilon": [float(value) for value, _ in by_epsilon], "ends": ends, "points": grid["points"]}
    return json.dumps(scale | points)


DOTS = {"printed_10_26": "(10.26)", "fast": "fast scale", "theory": "fast and slow", "exact": "exact orbit"}
"""Column head for each criterion in the verdict matrix."""


def verdict_dots(results) -> dict:
    """Return the verdict matrix, with one row for each fixed point.

    A row contains the verdict of each criterion of the theory. For each epsilon, the row also contains the verdict on
    the exact orbit and the largest modulus of a multiplier of this orbit.
    """
    table = results.table("verdicts_by_epsilon.csv")
    rows = [
        {
            "point": f"{case} {label}",
            "theory": [of_point[name].iloc[0] for name in DOTS if name != "exact"],
            "exact": [(row.exact, f"{row.multiplier:.3g}") for row in of_point.itertuples()],
        }
        for case, of_case in table.groupby("case", sort=False)
        for label, of_point in of_case.groupby("label")
    ]
    epsilon = [f"{value:g}" for value in table["epsilon"].unique()]
    return {"epsilon": epsilon, "heads": list(DOTS.values()), "rows": rows}
