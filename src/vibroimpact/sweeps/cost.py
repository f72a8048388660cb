"""What a sweep costs, measured on a few of its points, and into how many tiles that cuts it."""

import math
import time
from dataclasses import dataclass

from vibroimpact.sweeps.grid import Grid
from vibroimpact.sweeps.observations import Asked
from vibroimpact.sweeps.rows import rows

PROBED = 6
"""Points that are measured."""
ENOUGH = 120.0
"""Core seconds after which no further point is begun."""
MOST_TILES = 10_000
"""A file and a job each."""


@dataclass(frozen=True)
class Cost:
    """What was measured. points, runs: of the whole sweep. seconds: core seconds of each point that was measured."""

    points: int
    runs: int
    seconds: list[float]

    @property
    def core_seconds(self) -> float:
        """Estimate for the whole sweep."""
        return self.points * sum(self.seconds) / len(self.seconds)


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


def tiles(cost: Cost, target: float) -> int:
    """How many tiles to cut it into, so that each takes about `target` core seconds: points or MOST_TILES at most.

    For a target of 0 every point is a tile.

    Raises:
        ValueError: the target is below 0.
    """
    if target < 0:
        raise ValueError(f"tile_seconds: {target:g} is below 0")
    wanted = math.ceil(cost.core_seconds / target) if target else cost.points
    return max(1, min(wanted, cost.points, MOST_TILES))
