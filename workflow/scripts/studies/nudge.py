"""Write the motion after a small perturbation of a predicted motion: frames as JSON, and a picture."""

import json
from pathlib import Path

from vibroimpact_pipeline.jobs import running

from vibroimpact.figures.plotting.style import save
from vibroimpact.studies.figures.animation import PLACES
from vibroimpact.studies.figures.nudge import compute, draw
from vibroimpact.system import System

with running(snakemake) as out:
    found = compute(System(**snakemake.params.system))
    frames = {
        "cycles": int(found["distance"]["t"].max()) if len(found["distance"]) else 0,
        "places": list(PLACES.values()),
        "motion": {name: found["motion"][name].astype(float).round(4).tolist() for name in found["motion"]},
        **{name: found[name].astype(float).round(4).to_numpy().tolist() for name in ("impacts", "flights")},
        "distance": [float(f"{value:.3g}") for value in found["distance"]["distance"]],
        "multiplier": [float(f"{value:.6g}") for value in found["orbit"]["multiplier"]],
        "label": found["orbit"]["label"].tolist(),
    }
    Path(out.json).write_text(json.dumps(frames, separators=(",", ":")) + "\n", encoding="utf-8")
    save(draw(found), vars(out))
