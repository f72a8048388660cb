"""One tile of a sweep -> CSV: a row per point, each with the fingerprint of what was asked for."""

import pandas as pd

from job import running
from vibroimpact.figures.kit import tables
from vibroimpact.sweeps.request import fingerprint, understood
from vibroimpact.sweeps.rows import columns, rows
from vibroimpact_pipeline.sweeps.tiles import OF


def main(request: dict, number: int, tiles: int, output) -> None:
    grid, asked = understood(request)
    table = pd.DataFrame(rows(grid, asked, grid.tile(number, tiles)), columns=columns(grid, asked))
    table.insert(0, OF, fingerprint(request))
    tables.write(table, output)


if "snakemake" in globals():
    with running(snakemake):
        number, tiles = int(snakemake.wildcards.tile), int(snakemake.wildcards.tiles)
        main(snakemake.params.request, number, tiles, snakemake.output[0])
