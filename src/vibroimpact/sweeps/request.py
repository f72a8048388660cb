"""The request of a sweep as plain data that jobs hand on: parameters, axes and observations."""

import hashlib
import json
from collections.abc import Mapping

from vibroimpact.sweeps.asked import Asked
from vibroimpact.sweeps.grid import Grid, axis
from vibroimpact.system import System


def parsed(request: Mapping) -> tuple[Grid, Asked]:
    """The grid and what is observed there.

    Args:
        request: "system", parameters of System; "axes", a list of arguments of `grid.axis`; "asked", arguments of
            `asked.Asked`.

    Raises:
        ValueError: the parameters are not those of a system.
    """
    grid = Grid(System(**request["system"]), [axis(**one) for one in request["axes"]])
    return grid, Asked(**request["asked"])


def fingerprint(request: Mapping) -> str:
    """Return a hash of the request, which its tiles bear, so that no tile is taken for one of another sweep."""
    return hashlib.sha256(json.dumps(request, sort_keys=True).encode()).hexdigest()[:16]
