"""Map of regimes over both forcing amplitudes, cell by cell, so that it can be computed in tiles."""

from dataclasses import dataclass

import numpy as np

from vibroimpact.regimes.classification import REGIMES
from vibroimpact.regimes.families import FixedPoints
from vibroimpact.regimes.settling import Observation, settle


@dataclass(frozen=True)
class Cell:
    """What happens at one pair of forcing amplitudes.

    shares: part of the starts that end in each regime, by name. from_rest: where the first start, rest, ends.
    fixed_points, stable_points: number of fixed points of the theory, and of those it calls stable.
    """

    f10_hat: float
    f20_hat: float
    shares: dict[str, float]
    from_rest: str
    fixed_points: int
    stable_points: int


def centres(interval, points: int) -> np.ndarray:
    """Middles of so many equal cells of an interval, shape (points,)."""
    low, high = interval
    return low + (high - low) * (np.arange(points) + 0.5) / points


def tile(f10_range, f20_range, points: int, tile: int, tiles: int) -> np.ndarray:
    """The cells (f10_hat, f20_hat), shape (n, 2), of one tile, counted from 0.

    Every tiles-th cell belongs to it, so that all tiles take about the same time. Together the tiles are the map.
    """
    f10, f20 = np.meshgrid(centres(f10_range, points), centres(f20_range, points), indexing="ij")
    return np.stack([f10.ravel(), f20.ravel()], axis=1)[tile::tiles]


def cell(system, starts, observation: Observation) -> Cell:
    """Simulate from every start, shape (n, 8), rest first, and ask the theory."""
    regimes = [regime.name for regime in settle(system, starts, observation)]
    points = [FixedPoints.member(system, root) for root in FixedPoints.roots(system)]
    return Cell(
        f10_hat=system.f10_hat,
        f20_hat=system.f20_hat,
        shares={name: regimes.count(name) / len(regimes) for name in REGIMES},
        from_rest=regimes[0],
        fixed_points=len(points),
        stable_points=sum(FixedPoints.stable(system, point) for point in points),
    )
