"""Define the settings of a sweep, and convert plain data (a request) to these settings.

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
    """Names of the observations at every point of a sweep, and settings of these observations."""

    observe: tuple[str, ...]
    starts: int = 1  # number of initial states, which are drawn with `seed`
    seed: int = 0
    cycles: int = 0  # number of forcing periods of a run
    settle: int = 0  # number of forcing periods of a run before the observation begins
    band: dict | None = None  # arguments of `grid.axis` for the observation "peaks"
    observation: dict | None = None  # arguments of `Observation` for the observation "regimes"


def parsed(request: Mapping) -> tuple[Grid, Spec]:
    """Return the grid and the Spec of a request.

    The request has three keys. "system" contains the parameters of `System`, "axes" a list of arguments of `grid.axis`,
    and "spec" the arguments of `Spec`.

    Raises
    ------
    ValueError
        If the parameters do not give a valid system.
    """
    grid = Grid(System(**request["system"]), [axis(**one) for one in request["axes"]])
    return grid, Spec(**request["spec"])
