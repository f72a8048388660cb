"""What the page "Play" is given: parameters, cases, and the map of regimes."""

import json

import numpy as np

MAP = "companion_regime_map"


def live_data(results, config: dict, figures) -> str:
    """The data of the page as JSON.

    Args:
        results: a `results.Results`. config: of the pipeline.
        figures: names of the companion figures; without the map of regimes, the page has none.
    """
    cases = {name: [case["f10_hat"], case["f20_hat"]] for name, case in config["cases"].items()}
    regimes = regime_map(results.table(f"figures/{MAP}.csv")) if MAP in figures else None
    return json.dumps({"system": config["system"], "cases": cases, "first": next(iter(cases)), "map": regimes})


def regime_map(table) -> dict:
    """Forces of the columns (f10) and rows (f20), names of the regimes with their numbers of cells, the commonest
    first, and for each row of cells the places of their names in that list, -1 for none.
    """
    cells = table[table["series"] == "cell"]
    counts = cells["regime"].value_counts()
    grid = cells.pivot(index="f20_hat", columns="f10_hat", values="regime")
    places = counts.index.get_indexer(grid.to_numpy().ravel()).reshape(grid.shape)
    forces = {"f10": np.round(grid.columns, 6).tolist(), "f20": np.round(grid.index, 6).tolist()}
    return forces | {"regimes": counts.index.tolist(), "counts": counts.to_dict(), "cells": places.tolist()}
