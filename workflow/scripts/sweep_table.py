"""All tiles of a sweep -> one table, a row per point."""

import sys

from job import running
from vibroimpact.figures.kit import tables
from vibroimpact.sweeps.request import fingerprint, understood
from vibroimpact_pipeline.sweeps.tiles import NotOfThisSweep, gathered


def main(request: dict, paths, output) -> None:
    """Gather tiles.

    Raises:
        SystemExit: they are not those of the sweep.
    """
    grid, _ = understood(request)
    try:
        tables.write(gathered(paths, fingerprint(request), grid), output)
    except NotOfThisSweep as error:
        sys.exit(str(error))


if "snakemake" in globals():
    with running(snakemake):
        main(snakemake.params.request, list(snakemake.input), snakemake.output[0])
