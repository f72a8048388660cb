"""What a sweep costs, measured on a few of its points."""

import time

from vibroimpact.sweeps.asked import Asked
from vibroimpact.sweeps.cost import Cost
from vibroimpact.sweeps.grid import Grid
from vibroimpact.sweeps.rows import rows

PROBED = 6
"""Points that are measured."""
ENOUGH = 120.0
"""Core seconds after which no further point is begun."""


def probe(grid: Grid, asked: Asked) -> Cost:
    """Measure points that are spread over the grid, having seen that there is a system at every point.

    The first is observed twice, since what is loaded and compiled on the way is none of its cost.

    Raises:
        ValueError: a point has no system.
    """
    for number in range(len(grid)):
        grid.system(number)
    places, seconds = grid.spread(PROBED), []
    list(rows(grid, asked, places[:1]))
    for place in places:
        begin = time.process_time()
        list(rows(grid, asked, [place]))
        seconds.append(time.process_time() - begin)
        if sum(seconds) > ENOUGH:
            break
    return Cost(points=len(grid), runs=len(grid) * asked.runs, seconds=seconds)
