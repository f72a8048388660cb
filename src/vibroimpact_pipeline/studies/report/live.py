"""Data of the live pages: parameters, cases with the theory's prediction, verdicts over both forces."""

import json

import numpy as np

from vibroimpact.system.chapter import PARAMETERS
from vibroimpact.system.parameters import System
from vibroimpact.system.verdict import STABLE
from vibroimpact.theory.criteria import of_fixed_point
from vibroimpact.theory.fixed_points.symmetric_points import fixed_points
from vibroimpact.theory.response import leading_order
from vibroimpact_pipeline.specs import case_parameters

FORCES = ("f10_hat", "f20_hat")
SAMPLES = 200
"""Of a predicted response, over one cycle."""


def live_data(results, config: dict) -> str:
    """Return the data of the page Play as JSON: parameters, and of each case its forces and predicted responses, with
    what (10.26) says of each and the verdict and largest multiplier of its exact orbit.

    Cases that differ from the first in more than forces are left out.
    """
    given = {case: case_parameters(config, case) for case in config["cases"]}
    systems = {case: System(**{name: known[name] for name in (*PARAMETERS, *FORCES)}) for case, known in given.items()}
    first, *_ = systems.values()
    exact = _exact(results)
    cases = {}
    for name, system in systems.items():
        if system == first.with_(f10_hat=system.f10_hat, f20_hat=system.f20_hat):
            points = sorted(fixed_points(system), key=lambda point: point.label)
            told = [_point(system, point) | exact[name, point.label] for point in points]
            cases[name] = {"forces": [system.f10_hat, system.f20_hat], "points": told}
    return json.dumps({"system": {name: getattr(first, name) for name in PARAMETERS}, "cases": cases})


def _point(system, point):
    response = leading_order(system, point, np.arange(SAMPLES) / SAMPLES * system.period)
    told = {name: getattr(response, name)[:, 1].round(4).tolist() for name in ("X", "W")}
    return told | {"label": point.label, "printed": of_fixed_point(system, point)["printed_10_26"]}


def _exact(results) -> dict:
    """Return verdict and largest multiplier of the exact orbit of each fixed point, by case and label."""
    points, orbits = results.table("fixed_points.csv"), results.table("orbits.csv")
    moduli = orbits.set_index(["case", "label"])["modulus_1"]
    return {
        (row.case, row.label): {
            "exact": row.exact,
            "multiplier": f"{moduli[row.case, row.orbit]:.3g}" if (row.case, row.orbit) in moduli else "",
        }
        for row in points.itertuples()
    }


def verdict_data(results, config: dict) -> str:
    """Return the data of the slider of epsilon as JSON: for each epsilon the points that (10.26), or both time scales
    of the theory, call stable, [f10, f20, verdict on the exact orbit].
    """
    table, grid = results.table("verdict_grid.csv"), config["stability"]["verdict_grid"]
    by_epsilon = [
        (value, table[table["epsilon"] == value]) for value in sorted(table["epsilon"].unique(), reverse=True)
    ]
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
"""Criteria of the matrix of dots, with their heads."""


def verdict_dots(results) -> dict:
    """Return the matrix of verdicts: epsilon as listed, heads, and of each fixed point its verdicts by criterion and
    the exact ones by epsilon with the largest multiplier.
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
