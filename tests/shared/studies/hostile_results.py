"""Config and results with hostile texts."""

import copy
import json
from pathlib import Path

import pandas as pd

from configs import GOOD
from hostile import HOSTILE, STATEMENT
from vibroimpact.studies.regimes.classification import REGIMES

SHOWN = {
    "chapter": ["fig10_06"],
    "own": ["mine"],
    "companions": ["companion_basins"],
    "accuracy": ["work_precision", "stress_tests", "grazing", "models"],
    "nudge": ["nudge"],
}
PICTURE = '<svg xmlns="http://www.w3.org/2000/svg" width="300" height="200"><rect width="9" height="9"/></svg>'


def config() -> dict:
    """Return a config with texts that validation would refuse."""
    made = copy.deepcopy(GOOD)
    made["cases"] = {HOSTILE: made["cases"]["weak"], "equal": made["cases"]["equal"]}
    made["figures"] = {
        "fig10_06": made["figures"]["fig10_06"],
        "mine": {"like": "fig10_07", "case": HOSTILE, "fixed_point": HOSTILE, "periods": HOSTILE},
    }
    made["regimes"]["branches"]["case"] = "equal"
    made["system"][HOSTILE] = HOSTILE
    return made


def results(folder: Path) -> Path:
    """Write results in which every text is hostile, and return their folder."""
    numbers = {"C1": 1.0, "C2": 1.1, "B1": 0.1, "B2": 0.2, "psi1": 0.3, "psi2": 0.4}
    motion = {name: [0.0, 0.5] for name in ("t", "X1", "Y1", "X2", "Y2")} | {HOSTILE: [HOSTILE]}
    moving = {"cycles": 1, "motion": motion, "impacts": [[0.25, 1, 1]], "note": HOSTILE}
    run = {"error_state": 1e-9, "missed": 0, "spurious": 0, "seconds_per_cycle": 1e-6}
    run |= {"problem": HOSTILE, "method": HOSTILE, "setting": HOSTILE}
    claim = {"id": HOSTILE, "verdict": HOSTILE, "place": "(10.1)", "statement": STATEMENT, "parts": {HOSTILE: True}}
    claim |= {"refuted_by": STATEMENT}
    record = dict.fromkeys(("commit", "tree"), HOSTILE) | {"config": {HOSTILE: HOSTILE}, "code": {"lock": HOSTILE}}
    record |= {"steps": [{"method": HOSTILE, "digits": HOSTILE, "files": [HOSTILE]}], "versions": {HOSTILE: HOSTILE}}
    places = {figure: "figures" for figures in SHOWN.values() for figure in figures}
    places |= dict.fromkeys(("work_precision", "stress_tests", "grazing", "models"), "accuracy")
    places |= {"nudge": "nudge"}
    texts = {f"{place}/{figure}.provenance.json": json.dumps(record) for figure, place in places.items()}
    texts |= {f"{place}/{figure}.svg": PICTURE for figure, place in places.items()}
    texts |= {f"notebooks/{figure}.html": "<!DOCTYPE html><head></head>" for figure in ("fig10_06", "mine")}
    pushed = moving | {"flights": [], "distance": [1.0], "multiplier": [2.0], "label": [HOSTILE]}
    numbered = [claim | {"numbers": None}, claim | {"place": "Fig. 10.6", "numbers": {HOSTILE: [HOSTILE, 1.0]}}]
    data = {"nudge/nudge": pushed, "claims": numbered}
    texts |= {f"{name}.json": json.dumps(content) for name, content in data.items()}
    hostile = dict.fromkeys(("case", "label", "exact", "printed_10_26", "fast", "slow", "theory"), HOSTILE)
    points = [{"case": case, "label": label} for case in (HOSTILE, "equal") for label in (HOSTILE, "a", "b", "c")]
    grid = {"epsilon": 0.1, "f20_hat": 0.5, "admissible": True}
    tables = {
        "fixed_points.csv": [hostile | numbers | {"orbit": HOSTILE} | point for point in points],
        "verdict_grid.csv": [hostile | grid | {"f10_hat": f10} for f10 in (0.5, 1.5)],
        "orbits.csv": [hostile | {"modulus_1": 2.0}],
        "verdicts_by_epsilon.csv": [hostile | {"epsilon": 0.1, "multiplier": 2.0}],
        "accuracy/work_precision.csv": [
            run | {"outcome": outcome, "reason": HOSTILE} for outcome in ("finished", HOSTILE)
        ],
        "accuracy/choices.csv": [run | {"error": 1e-6, "choice": 1, "wrong": 0}],
        "accuracy/stress_tests.csv": [run | {"group": HOSTILE, "test": HOSTILE, "verdict": "right"}],
        "sweeps/regime_map.csv": [{"f10_hat": 0.5, "f20_hat": 0.5, "note": HOSTILE} | dict.fromkeys(REGIMES, 0.1)],
        "regimes/special_points.csv": [
            {"path": "f20_hat", "family": "fixed point", "kind": HOSTILE, "p": 0.45, "admissible": True}
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
