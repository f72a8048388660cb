"""Compute fixed points and exact 1:1 responses of one case, with verdicts and proofs; write CSV.

A 1:1 response has one impact at each wall per forcing period. search.json describes the search for asymmetric
responses. It contains the number of responses found, and the number of first values of Newton's method. For each
response, the search counts the first values that led to the response or to its mirror image. search.json contains the
smallest of these counts.
"""

import json
from pathlib import Path

from vibroimpact_pipeline.jobs import running

from vibroimpact import tables
from vibroimpact.accuracy.verdict_table import CRITERIA, fixed_point_rows, orbit_rows
from vibroimpact.exact.orbits.search import search
from vibroimpact.system import System
from vibroimpact.theory.fixed_points.table import fixed_point_table, labelled_points

with running(snakemake) as out:
    case, system = snakemake.wildcards.case, System(**snakemake.params.system)
    points, found = fixed_point_table(case, system).drop(columns="multiple"), search(system)
    orbits = orbit_rows(case, [orbit.with_proof() for orbit in found.orbits])
    verdicts = fixed_point_rows(case, system, labelled_points(points), orbits)
    verdicts = verdicts[["label", "admissible", "orbit", *CRITERIA]]
    tables.write(points.merge(verdicts, on="label", validate="one_to_one"), out.points)
    tables.write(orbits, out.orbits)
    listed = sum(not orbit.symmetric for orbit in found.orbits)
    effort = {"listed": listed, "starts": found.starts, "fewest_hits": found.fewest_hits}
    Path(out.search).write_text(json.dumps(effort) + "\n", encoding="utf-8")
