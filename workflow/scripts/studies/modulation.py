"""Write three CSV files for all cases, with measures of modulation and Lyapunov spectra.

One of the files contains measures of modulation that are computed from time intervals of several lengths.
"""

from vibroimpact_pipeline.jobs import running

from vibroimpact import tables
from vibroimpact.studies.claims.modulation_tables import modulation_tables
from vibroimpact.system import System

with running(snakemake) as out:
    systems = {case: System(**parameters) for case, parameters in snakemake.params.systems.items()}
    for name, table in modulation_tables(systems, **snakemake.params.settings).items():
        tables.write(table, getattr(out, name))
