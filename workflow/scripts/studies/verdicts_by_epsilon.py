"""Write a CSV table of the verdicts on the fixed points of all cases, for several values of epsilon."""

from vibroimpact_pipeline.jobs import running

import pandas as pd

from vibroimpact import tables
from vibroimpact.studies.claims.verdict_grid import by_epsilon
from vibroimpact.system import System

with running(snakemake) as out:
    judged = {
        case: by_epsilon(System(**parameters), snakemake.params.epsilon)
        for case, parameters in snakemake.params.systems.items()
    }
    tables.write(pd.concat(judged, names=["case"]).reset_index("case"), out.csv)
