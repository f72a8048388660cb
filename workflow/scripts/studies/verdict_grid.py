"""Write the verdicts on fixed points at several epsilon: over a grid of forcing amplitudes, and for all cases."""

from vibroimpact_pipeline.jobs import running

import pandas as pd

from vibroimpact import tables
from vibroimpact.studies.claims.verdict_grid import by_epsilon, compute
from vibroimpact.system import System

with running(snakemake) as out:
    settings = snakemake.params.settings
    tables.write(compute(System(**snakemake.params.system), **settings), out.csv)
    cases = {case: System(**parameters) for case, parameters in snakemake.params.systems.items()}
    judged = {case: by_epsilon(system, settings["epsilon"]) for case, system in cases.items()}
    tables.write(pd.concat(judged, names=["case"]).reset_index("case"), out.by_epsilon)
