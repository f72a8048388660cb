"""Where chaos and periodic motions coexist -> CSV: mean lives, tori, and where these begin."""

from job import running
from vibroimpact.figures.kit import tables
from vibroimpact.regimes.coexistence import compute_lifetimes, compute_tori
from vibroimpact.system import System


def main(parameters: dict, lifetimes: dict, tori: dict, observation: dict, outputs: dict) -> None:
    """Compute and write the tables, each to the output of its name."""
    system = System(**parameters)
    found = {"lifetimes": compute_lifetimes(system, observation=observation, **lifetimes)}
    for name, table in (found | compute_tori(system, **tori)).items():
        tables.write(table, outputs[name])


if "snakemake" in globals():
    with running(snakemake):
        params = snakemake.params
        main(params.system, params.lifetimes, params.tori, params.observation, dict(snakemake.output.items()))
