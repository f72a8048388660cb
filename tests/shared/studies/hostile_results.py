"""A config and results that are full of hostile texts."""

import copy
import json
from pathlib import Path

import pandas as pd

from configs import GOOD
from hostile import HOSTILE, STATEMENT

SHOWN = {
    "chapter": ["fig10_06"],
    "own": ["mine"],
    "companions": ["companion_basins"],
    "accuracy": ["work_precision", "stress_tests", "grazing", "models"],
    "animations": ["waves"],
    "force_sweep": ["force_sweep"],
    "nudge": ["nudge"],
}
PICTURE = '<svg xmlns="http://www.w3.org/2000/svg" width="300" height="200"><rect width="9" height="9"/></svg>'


def config() -> dict:
    """A config with texts that its check would refuse."""
    made = copy.deepcopy(GOOD)
    made["cases"] = {HOSTILE: made["cases"]["weak"], "equal": made["cases"]["equal"]}
    made["figures"] = {
        "fig10_06": made["figures"]["fig10_06"],
        "mine": {"like": "fig10_07", "case": HOSTILE, "fixed_point": HOSTILE, "periods": HOSTILE},
    }
    made["report"]["animations"] = {"waves": {"case": HOSTILE, "cycles": 1}}
    made["regimes"]["branches"]["case"] = "equal"
    made["system"][HOSTILE] = HOSTILE
    return made


def results(folder: Path) -> Path:
    """Results in which every text is hostile."""
    numbers = {"C1": 1.0, "C2": 1.1, "B1": 0.1, "B2": 0.2, "psi1": 0.3, "psi2": 0.4}
    point = {
        "label": HOSTILE,
        "track": 1,
        "C": [1.0, 1.1],
        "B": [0.1, 0.2],
        "verdicts": {"slow": HOSTILE, "other": HOSTILE},
    }
    orbit = {"track": 1, "C": [1.0, 1.1], "exact": HOSTILE, "multipliers": [[2.0, 0.0], [0.5, 0.1]]}
    sweep = {"values": [0.4, 0.5], "points": [[point], [point]], "manifold": {HOSTILE: [[0.0, 1.0], [1.0, 0.1]]}}
    sweep |= {"orbits": [[orbit], [orbit]]}
    motion = {name: [0.0, 0.5] for name in ("t", "X1", "Y1", "X2", "Y2")} | {HOSTILE: [HOSTILE]}
    moving = {"cycles": 1, "places": [-3.0, 3.0], "motion": motion, "impacts": [[0.25, 1, 1]], "note": HOSTILE}
    run = {"error_state": 1e-9, "missed": 0, "spurious": 0, "seconds_per_cycle": 1e-6}
    run |= {"problem": HOSTILE, "method": HOSTILE, "setting": HOSTILE}
    claim = {"id": HOSTILE, "verdict": HOSTILE, "place": "(10.1)", "statement": STATEMENT, "parts": {HOSTILE: True}}
    claim |= {"refuted_by": STATEMENT}
    record = dict.fromkeys(("commit", "tree"), HOSTILE) | {"config": {HOSTILE: HOSTILE}, "code": {"lock": HOSTILE}}
    record |= {"steps": [{"method": HOSTILE, "digits": HOSTILE, "files": [HOSTILE]}], "versions": {HOSTILE: HOSTILE}}
    places = {figure: "figures" for figures in SHOWN.values() for figure in figures}
    places |= dict.fromkeys(("work_precision", "stress_tests", "grazing", "models"), "accuracy")
    places |= {"waves": "animations", "force_sweep": "force_sweep", "nudge": "nudge"}
    texts = {f"{place}/{figure}.provenance.json": json.dumps(record) for figure, place in places.items()}
    texts |= {f"{place}/{figure}.svg": PICTURE for figure, place in places.items()}
    texts |= {f"notebooks/{figure}.html": "<!DOCTYPE html><head></head>" for figure in ("fig10_06", "mine")}
    texts |= {
        "animations/waves.json": json.dumps(moving),
        "nudge/nudge.json": json.dumps(
            moving | {"flights": [], "distance": [1.0], "multiplier": [2.0], "label": [HOSTILE]}
        ),
        "force_sweep/force_sweep.json": json.dumps(sweep),
        "claims.json": json.dumps(
            [claim | {"numbers": None}, claim | {"place": "Fig. 10.6", "numbers": {HOSTILE: [HOSTILE, 1.0]}}]
        ),
    }
    tables = {
        "fixed_points.csv": [
            {"case": case, "label": label, "orbit": HOSTILE, "exact": HOSTILE} | numbers
            for case in (HOSTILE, "equal")
            for label in (HOSTILE, "a", "b", "c")
        ],
        "verdict_grid.csv": [
            {"epsilon": 0.1, "f10_hat": f10, "f20_hat": 0.5, "exact": HOSTILE, "admissible": True}
            | {"printed_10_26": HOSTILE, "fast": HOSTILE, "slow": HOSTILE, "theory": HOSTILE}
            for f10 in (0.5, 1.5)
        ],
        "orbits.csv": [{"case": HOSTILE, "label": HOSTILE, "modulus_1": 2.0}],
        "verdicts_by_epsilon.csv": [
            {"epsilon": 0.1, "case": HOSTILE, "label": HOSTILE, "exact": HOSTILE, "multiplier": 2.0}
            | {"printed_10_26": HOSTILE, "fast": HOSTILE, "theory": HOSTILE}
        ],
        "accuracy/work_precision.csv": [
            run | {"outcome": "finished", "reason": ""},
            run | {"outcome": HOSTILE, "reason": HOSTILE},
        ],
        "accuracy/stress_tests.csv": [
            {"group": HOSTILE, "test": HOSTILE, "method": HOSTILE, "verdict": "right"}
            | {"error_state": 1e-9, "missed": 0, "spurious": 0}
        ],
        "force_sweep/force_sweep.csv": [
            {"value": 0.4, "theory": HOSTILE},
            {"value": 0.5, "theory": "stable"},
        ],
        "regimes/special_points.csv": [
            {"path": "f20_hat", "family": "fixed point", "kind": HOSTILE, "p": 0.45, "admissible": True}
        ],
        "accuracy/models.csv": [
            {"figure": "mine", "model": HOSTILE, "compared_with": HOSTILE, "error": 1e-9, "tolerance": 1e-3}
            | {"seconds": 0.1, "in_use": True}
        ],
    }
    for name, text in texts.items():
        _made(folder / name).write_text(text, encoding="utf-8")
    for name, rows in tables.items():
        pd.DataFrame(rows).to_csv(_made(folder / name), index=False)
    return folder


def _made(path):
    path.parent.mkdir(parents=True, exist_ok=True)
    return path
