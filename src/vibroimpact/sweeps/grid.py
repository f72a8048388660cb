"""The grid of a sweep: the values that parameters move through, alone or together, and the systems there."""

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from vibroimpact.system import System

LINEAR, LOGARITHMIC = "linear", "logarithmic"
SPACED = {LINEAR: np.linspace, LOGARITHMIC: np.geomspace}
"""How the values of an axis lie between its ends."""
LEAPS = {1: (0.6180339887498949,), 2: (0.7548776662466927, 0.5698402909980532)}
"""Steps that, taken again and again modulo 1, spread evenly over a line, over a square (Roberts 2018)."""


@dataclass(frozen=True)
class Axis:
    """Parameters that move together through values, all dimensionless."""

    along: tuple[str, ...]
    values: tuple[float, ...]


def axis(along: Sequence[str], range=None, values: int | None = None, scale: str = LINEAR, listed=None) -> Axis:
    """The axis of `values` values from one end of a range to the other, both included, or of those listed.

    Args:
        along: names of parameters of System. scale: one of SPACED.
    """
    through = listed if listed is not None else SPACED[scale](*range, values)
    return Axis(tuple(along), tuple(float(value) for value in through))


class Grid:
    """The points of a sweep, numbered from 0, those of the last axis fastest.

    Args:
        system: whose other parameters are kept. axes: one or two.
    """

    def __init__(self, system: System, axes: Sequence[Axis]):
        self.base, self.axes = system, tuple(axes)
        self.shape = tuple(len(axis.values) for axis in self.axes)

    def __len__(self):
        return math.prod(self.shape)

    def place(self, number: int) -> dict[str, float]:
        """The value of every parameter that moves, by name, at a point."""
        places = np.unravel_index(number, self.shape)
        return {name: axis.values[k] for axis, k in zip(self.axes, places, strict=True) for name in axis.along}

    def system(self, number: int) -> System:
        """The system at a point.

        Raises:
            ValueError: there is none; it says where.
        """
        place = self.place(number)
        try:
            return self.base.with_(**place)
        except ValueError as error:
            where = ", ".join(f"{name} = {value:.6g}" for name, value in place.items())
            raise ValueError(f"at {where}: {error}") from None

    def tile(self, number: int, tiles: int) -> range:
        """Points of one of so many tiles, counted from 1: every tiles-th, so that all take about the same time."""
        return range(number - 1, len(self), tiles)

    def spread(self, most: int) -> list[int]:
        """At most so many different points, spread evenly over the grid."""
        steps = np.outer(np.arange(most) + 0.5, LEAPS[len(self.shape)]) % 1.0
        return sorted({int(np.ravel_multi_index((step * self.shape).astype(int), self.shape)) for step in steps})
