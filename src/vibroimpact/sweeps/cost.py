"""What a sweep costs, and into how many tiles that cuts it."""

import math
from dataclasses import dataclass

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
