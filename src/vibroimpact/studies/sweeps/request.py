"""Request of a sweep as plain data: parameters, axes and observations."""

from collections.abc import Mapping

from vibroimpact.studies.sweeps.grid import Grid, axis
from vibroimpact.studies.sweeps.spec import Spec
from vibroimpact.system import System


def parsed(request: Mapping) -> tuple[Grid, Spec]:
    """Return the grid of a request, and the Spec of its observations.

    Parameters
    ----------
    request : Mapping
        "system": parameters of System; "axes": a list of arguments of `grid.axis`; "spec": arguments of `spec.Spec`.

    Raises
    ------
    ValueError
        If the parameters do not give a valid system.
    """
    grid = Grid(System(**request["system"]), [axis(**one) for one in request["axes"]])
    return grid, Spec(**request["spec"])
