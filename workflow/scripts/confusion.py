"""Names of regimes against longer runs -> CSV: name, name later, number of starts."""

from collections import Counter

import pandas as pd

from job import running
from vibroimpact.figures.kit import tables
from vibroimpact.regimes.cells import plane_of_forces
from vibroimpact.regimes.classification import REGIMES, starts
from vibroimpact.regimes.confusion import confusion
from vibroimpact.regimes.settling import Observation
from vibroimpact.system import System


def main(parameters: dict, settings: dict, observation: dict, output) -> None:
    """Gather over the cells of a coarse map of forcing amplitudes."""
    system, states = System(**parameters), starts(settings["starts"], settings["seed"])
    counts = Counter()
    for f10, f20 in plane_of_forces(settings["f10_range"], settings["f20_range"], settings["points"]):
        cell = system.with_(f10_hat=f10, f20_hat=f20)
        counts += confusion(cell, states, Observation(**observation), settings["times"])
    rows = [(name, later, counts[name, later]) for name in REGIMES for later in REGIMES if counts[name, later]]
    tables.write(pd.DataFrame(rows, columns=["name", "later", "starts"]), output)


if "snakemake" in globals():
    with running(snakemake):
        params = snakemake.params
        main(params.system, params.settings, params.observation, snakemake.output[0])
