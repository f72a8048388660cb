"""Settings of a sweep, and their conversion from plain data (a request).

Importing this module does not load the simulation engine.
"""

from collections.abc import Mapping
from dataclasses import dataclass

from vibroimpact.studies.sweeps.grid import Grid, axis
from vibroimpact.system import System

POINT, FAILED = "point", "failed"
"""First and last column of the table of a sweep: number of the point, and why an observation failed there, or ""."""


@dataclass(frozen=True)
class Spec:
    """Observations at every point of a sweep, and their settings.

    observe: names of the observations. starts, seed: number of initial states, and the seed from which they are drawn,
    see `regimes.classification.starts`. cycles: forcing periods of a run. settle: forcing periods at the start of a run
    that are not observed. band: arguments of `grid.axis`, which give the parameter values at which the observation
    "peaks" looks for the highest peak. observation: arguments of `regimes.settling.Observation`.
    """

    observe: tuple[str, ...]
    starts: int = 1
    seed: int = 0
    cycles: int = 0
    settle: int = 0
    band: dict | None = None
    observation: dict | None = None


def parsed(request: Mapping) -> tuple[Grid, Spec]:
    """Return the grid of a request, and the Spec of its observations.

    Parameters
    ----------
    request : Mapping
        "system": parameters of System; "axes": a list of arguments of `grid.axis`; "spec": arguments of `Spec`.

    Raises
    ------
    ValueError
        If the parameters do not give a valid system.
    """
    grid = Grid(System(**request["system"]), [axis(**one) for one in request["axes"]])
    return grid, Spec(**request["spec"])
