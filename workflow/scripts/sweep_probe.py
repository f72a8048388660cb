"""A few points of a sweep, measured -> JSON: points and runs of the whole, core seconds of each measured point."""

import json
from dataclasses import asdict

from job import running
from vibroimpact.figures.kit.files import replacing
from vibroimpact.sweeps.cost import probe
from vibroimpact.sweeps.request import understood


def main(request: dict, output) -> None:
    cost = probe(*understood(request))
    with replacing(output) as partial:
        partial.write_text(json.dumps(asdict(cost)) + "\n", encoding="utf-8")


if "snakemake" in globals():
    with running(snakemake):
        main(snakemake.params.request, snakemake.output[0])
