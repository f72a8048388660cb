"""Data of the live pages: parameters, cases, the map of regimes; verdicts over both forces."""

import json

import numpy as np

from vibroimpact.system.verdict import STABLE
from vibroimpact_pipeline.specs import case_parameters

MAP = "companion_regime_map"


def live_data(results, config: dict, figures) -> str:
    """Return the data of the page Play as JSON.

    Args:
        results: a `results.Results`. config: of the pipeline; cases that differ from the first in more than forces
            are left out.
        figures: names of the companion figures; without the map of regimes, the page has none.
    """
    first = next(iter(config["cases"]))
    systems = {name: case_parameters(config, name) for name in config["cases"]}
    forces = {name: [system.pop("f10_hat"), system.pop("f20_hat")] for name, system in systems.items()}
    cases = {name: forces[name] for name, system in systems.items() if system == systems[first]}
    regimes = regime_map(results.table(f"figures/{MAP}.csv")) if MAP in figures else None
    return json.dumps({"system": systems[first], "cases": cases, "first": first, "map": regimes})


def regime_map(table) -> dict:
    """Return the map of regimes: forces of the columns (f10) and rows (f20), names of the regimes with their numbers of
    cells, the commonest first, and for each row of cells the indices of their names, -1 for none.
    """
    cells = table[table["series"] == "cell"]
    counts = cells["regime"].value_counts()
    grid = cells.pivot(index="f20_hat", columns="f10_hat", values="regime")
    places = counts.index.get_indexer(grid.to_numpy().ravel()).reshape(grid.shape)
    forces = {"f10": np.round(grid.columns, 6).tolist(), "f20": np.round(grid.index, 6).tolist()}
    return forces | {"regimes": counts.index.tolist(), "counts": counts.to_dict(), "cells": places.tolist()}


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
