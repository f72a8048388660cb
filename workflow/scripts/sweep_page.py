"""What a sweep asked for and found -> one HTML page that reads offline."""

import json
from pathlib import Path

from job import running
from vibroimpact.figures.kit.files import replacing
from vibroimpact.figures.kit.tables import read
from vibroimpact_pipeline.sweeps.page import page


def main(name: str, request: dict, inputs: dict, output) -> None:
    plan = json.loads(Path(inputs["plan"]).read_text(encoding="utf-8"))
    text = page(name, request, plan, read(inputs["table"]), Path(inputs["svg"]).read_bytes())
    with replacing(output) as partial:
        partial.write_text(text, encoding="utf-8")


if "snakemake" in globals():
    with running(snakemake):
        main(snakemake.wildcards.sweep, snakemake.params.request, dict(snakemake.input.items()), snakemake.output[0])
