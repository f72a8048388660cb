"""All exact 1:1 responses of one case, verdicts and proofs -> CSV, a row per orbit, and JSON with the effort."""

import json
from pathlib import Path

from vibroimpact_pipeline.jobs import running

import pandas as pd

from vibroimpact import tables
from vibroimpact.accuracy.verdict_table import orbit_rows
from vibroimpact.exact.orbits.proof.table import proof_rows
from vibroimpact.exact.orbits.search import search
from vibroimpact.system import System

with running(snakemake) as out:
    found = search(System(**snakemake.params.system))
    rows = pd.concat([orbit_rows(snakemake.wildcards.case, found.orbits), proof_rows(found.orbits)], axis="columns")
    tables.write(rows, out.csv)
    listed = sum(not orbit.symmetric for orbit in found.orbits)
    effort = {"listed": listed, "starts": found.starts, "fewest_hits": found.fewest_hits}
    Path(out.search).write_text(json.dumps(effort) + "\n", encoding="utf-8")
