"""Verdicts of the rungs without harmonics on every motion over a grid of forces and several epsilon -> CSV, counted."""

import pandas as pd

from job import running
from vibroimpact.figures.companion_ladder import verdicts
from vibroimpact.figures.kit import tables
from vibroimpact.regimes.cells import plane_of_forces
from vibroimpact.regimes.ladder import rungs
from vibroimpact.system import System


def main(parameters: dict, settings: dict, output) -> None:
    """The grid is that of the verdict grid: its numbers of motions are those of leading order there."""
    system = System(**parameters)
    places = plane_of_forces(settings["f10_range"], settings["f20_range"], settings["points"])
    plane = [system.with_(f10_hat=f10, f20_hat=f20) for f10, f20 in places]
    counted = [
        verdicts(rungs(place.with_(epsilon=epsilon), []) for place in plane).assign(epsilon=epsilon)
        for epsilon in settings["epsilon"]
    ]
    tables.write(pd.concat(counted, ignore_index=True), output)


if "snakemake" in globals():
    with running(snakemake):
        main(snakemake.params.system, snakemake.params.settings, snakemake.output[0])
