"""One tile of the map of regimes -> CSV: a row per pair of forcing amplitudes."""

from job import running
from vibroimpact.figures.companions.companion_regime_map import compute_tile
from vibroimpact.figures.kit import tables
from vibroimpact.system import System


def main(item: str, parameters: dict, settings: dict, observation: dict, output) -> None:
    """Compute the tile `item`, "1-of-4" say."""
    number, tiles = (int(part) for part in item.split("-of-"))
    tables.write(compute_tile(System(**parameters), number - 1, tiles, observation=observation, **settings), output)


if "snakemake" in globals():
    with running(snakemake):
        params = snakemake.params
        item = snakemake.wildcards.scatteritem
        main(item, params.system, params.settings, params.observation, snakemake.output[0])
