"""Write fixed points over a range of one forcing amplitude as CSV, as JSON for the slider, and as a picture."""

import json
from pathlib import Path

from vibroimpact_pipeline.jobs import running

import numpy as np

from vibroimpact import tables
from vibroimpact.figures.plotting.style import save
from vibroimpact.studies.figures.force_sweep import VERDICTS, compute, draw
from vibroimpact.system import System


def for_page(found: dict, values: list) -> dict:
    """Return the data of the slider: both branches of the manifold, fixed points and exact orbits at each value."""
    manifold = {
        series: rows[["C", "B"]].round(4).to_numpy().tolist() for series, rows in found["manifold"].groupby("series")
    }
    points = {value: [] for value in values}
    rows = found["points"].sort_values(["value", "label"]).round(dict.fromkeys(("C1", "B1", "C2", "B2"), 4))
    for row in rows.to_dict("records"):
        verdicts = {name: row[name] for name in VERDICTS}
        place = {"label": row["label"], "track": row["track"], "C": [row["C1"], row["C2"]], "B": [row["B1"], row["B2"]]}
        points[row["value"]].append(place | {"verdicts": verdicts})
    orbits = {value: [] for value in values}
    for (value, track, C1, C2), rows in found["orbits"].groupby(["value", "track", "C1", "C2"]):
        place = {"track": track, "C": [round(C1, 4), round(C2, 4)], "exact": rows["exact"].iloc[0]}
        orbits[value].append(place | {"multipliers": rows[["real", "imag"]].round(4).to_numpy().tolist()})
    lists = {"points": list(points.values()), "orbits": list(orbits.values())}
    return {"manifold": manifold, "values": values, **lists}


with running(snakemake) as out:
    parameters, settings = snakemake.params.system, snakemake.params.settings
    values = np.round(np.linspace(*settings["range"], settings["values"]), 6).tolist()
    systems = {value: System(**parameters | {"f20_hat": value}) for value in values}
    found = compute(systems, settings["C_max"])
    tables.write(found["points"], out.csv)
    Path(out.json).write_text(json.dumps(for_page(found, values), separators=(",", ":")) + "\n", encoding="utf-8")
    save(draw(found), vars(out))
