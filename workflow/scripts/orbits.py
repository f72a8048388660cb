"""All exact 1:1 responses of one case, verdicts and proofs -> CSV, a row per orbit, and JSON: the effort spent."""

import json

import pandas as pd

from job import running
from vibroimpact.claims.orbit_proofs import proof_rows
from vibroimpact.claims.verdict_table import orbit_rows
from vibroimpact.exact.orbits.search import search
from vibroimpact.figures.kit import tables
from vibroimpact.figures.kit.files import replacing
from vibroimpact.system import System


def main(case: str, parameters: dict, outputs: dict) -> None:
    found = search(System(**parameters))
    rows = pd.concat([orbit_rows(case, found.orbits), proof_rows(found.orbits)], axis="columns")
    tables.write(rows, outputs["csv"])
    listed = sum(not orbit.symmetric for orbit in found.orbits)
    effort = {"listed": listed, "starts": found.starts, "fewest_hits": found.fewest_hits}
    with replacing(outputs["search"]) as partial:
        partial.write_text(json.dumps(effort) + "\n", encoding="utf-8")


if "snakemake" in globals():
    with running(snakemake):
        main(snakemake.wildcards.case, snakemake.params.system, dict(snakemake.output.items()))
