"""Coexistence of chaos and periodic motions -> CSV: mean lifetimes, tori, and their onsets."""

from vibroimpact.figures.kit import tables
from vibroimpact.regimes.coexistence import compute_lifetimes, compute_tori
from vibroimpact.system import System
from vibroimpact_pipeline.jobs import running

with running(snakemake) as out:
    params = snakemake.params
    system = System(**params.system)
    found = {"lifetimes": compute_lifetimes(system, observation=params.observation, **params.lifetimes)}
    for name, table in (found | compute_tori(system, **params.tori)).items():
        tables.write(table, getattr(out, name))
