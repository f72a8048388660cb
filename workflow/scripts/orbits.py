"""All exact 1:1 responses of one case with the verdicts on them -> CSV, a row per orbit."""

from job_log import logging_to
from vibroimpact.claims.verdict_table import orbit_rows
from vibroimpact.exact.orbits.search import search
from vibroimpact.figures.kit import tables
from vibroimpact.system import System


def main(case: str, parameters: dict, output) -> None:
    found = search(System(**parameters))
    print(f"{found.starts} starts for the asymmetric orbits; the one hit least was hit {found.fewest_hits} times")
    tables.write(orbit_rows(case, found.orbits), output)


if "snakemake" in globals():
    with logging_to(snakemake.log[0]):
        main(snakemake.wildcards.case, snakemake.params.system, snakemake.output[0])
