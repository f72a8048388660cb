"""Write the frames of an animation as JSON and one frame as a picture, from a simulated window."""

import json
from pathlib import Path

from vibroimpact_pipeline.jobs import running

from vibroimpact import tables
from vibroimpact.figures.plotting.style import save
from vibroimpact.studies.figures.animation import PLACES, compute, draw
from vibroimpact.system import System

DECIMALS = {"t": 4, "X1": 3, "Y1": 3, "X2": 3, "Y2": 3}
"""Decimals of each column; 0.001 L is less than a pixel."""

with running(snakemake) as out:
    samples, events = tables.read(snakemake.input.samples), tables.read(snakemake.input.events)
    shown = compute(samples, events, System(**snakemake.params.system).period, snakemake.params.cycles)
    frames = {
        "cycles": snakemake.params.cycles,
        "places": list(PLACES.values()),
        "motion": {name: shown["motion"][name].round(digits).tolist() for name, digits in DECIMALS.items()},
        "impacts": shown["impacts"].round({"t": DECIMALS["t"]}).to_numpy().tolist(),
    }
    Path(out.json).write_text(json.dumps(frames, separators=(",", ":")) + "\n", encoding="utf-8")
    save(draw(shown), vars(out))
