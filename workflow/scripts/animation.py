"""A window of a simulation -> the frames of an animation as JSON, and a still of it as a picture."""

import json

from job import running
from vibroimpact.figures.animation import PLACES, compute, draw
from vibroimpact.figures.kit.files import replacing
from vibroimpact.figures.kit.style import save
from vibroimpact.figures.kit.tables import read
from vibroimpact.system import System

DECIMALS = {"t": 4, "X1": 3, "Y1": 3, "X2": 3, "Y2": 3}
"""A thousandth of L is less than a pixel."""


def main(parameters: dict, cycles: int, inputs, outputs) -> None:
    tables = compute(read(inputs["samples"]), read(inputs["events"]), System(**parameters).period, cycles)
    columns = {name: tables["motion"][name].round(digits).tolist() for name, digits in DECIMALS.items()}
    impacts = tables["impacts"].round({"t": DECIMALS["t"]}).to_numpy().tolist()
    with replacing(outputs["json"]) as partial:
        content = {"cycles": cycles, "places": list(PLACES.values()), "motion": columns, "impacts": impacts}
        partial.write_text(json.dumps(content, separators=(",", ":")) + "\n", encoding="utf-8")
    save(draw(tables), outputs)


if "snakemake" in globals():
    with running(snakemake):
        main(snakemake.params.system, snakemake.params.cycles, snakemake.input, dict(snakemake.output.items()))
