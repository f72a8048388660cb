"""A few points of a sweep, measured -> JSON: points and runs of the whole, core seconds of each measured point."""

import json
import sys
from dataclasses import asdict

from job import running
from vibroimpact.figures.kit.files import replacing
from vibroimpact.sweeps.probe import probe
from vibroimpact.sweeps.request import understood


def main(name: str, request: dict, output) -> None:
    try:
        cost = probe(*understood(request))
    except ValueError as error:
        sys.exit(f"sweeps.{name}: {error}")
    with replacing(output) as partial:
        partial.write_text(json.dumps(asdict(cost)) + "\n", encoding="utf-8")


if "snakemake" in globals():
    with running(snakemake):
        main(snakemake.wildcards.sweep, snakemake.params.request, snakemake.output[0])
