"""Fixed points and exact 1:1 responses of all cases, with the verdict of each criterion and with proofs.

fixed_points.csv and orbits.csv have a row each; orbits.search.json gives by case the number of Newton starts with which
asymmetric orbits were searched.
"""

import json
import sys
from pathlib import Path

from vibroimpact_pipeline.jobs import running

import pandas as pd

from vibroimpact import tables
from vibroimpact.accuracy.verdict_table import CRITERIA, FORMER, fixed_point_rows, orbit_rows
from vibroimpact.exact.orbits.proof.table import proof_rows
from vibroimpact.exact.orbits.search import search
from vibroimpact.system import System
from vibroimpact.theory.fixed_points.table import fixed_point_table, labelled_points


def judged_points(case: str, system, orbits: pd.DataFrame) -> pd.DataFrame:
    """Return the fixed points of a case with the verdict of each criterion, by label."""
    points = fixed_point_table(case, system).drop(columns="multiple")
    labelled = [(point.label, point) for point in labelled_points(points)]
    verdicts = fixed_point_rows(case, system, labelled, orbits)[["label", "admissible", "orbit", *CRITERIA, *FORMER]]
    return points.merge(verdicts, on="label", validate="one_to_one")


with running(snakemake) as out:
    points, orbits, searches = [], [], {}
    for case, parameters in snakemake.params.systems.items():
        try:
            system = System(**parameters)
            found = search(system)
            orbits.append(orbit_rows(case, found.orbits))
            points.append(judged_points(case, system, orbits[-1]))
            orbits[-1] = pd.concat([orbits[-1], proof_rows(found.orbits)], axis="columns")
        except ValueError as error:
            sys.exit(f"cases.{case}: {error}")
        listed = sum(not orbit.symmetric for orbit in found.orbits)
        searches[case] = {"listed": listed, "starts": found.starts, "fewest_hits": found.fewest_hits}
    tables.write(pd.concat(points, ignore_index=True), out.csv)
    tables.write(pd.concat(orbits, ignore_index=True), out.orbits)
    Path(out.search).write_text(json.dumps(searches, indent=1) + "\n", encoding="utf-8")
