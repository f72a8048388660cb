"""Grid of a sweep: axes with one or more parameters each, and the system at each point."""

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from vibroimpact.studies.regimes.midpoint_grid import centres
from vibroimpact.system import System

LINEAR, LOGARITHMIC = "linear", "logarithmic"
SPACED = {LINEAR: np.linspace, LOGARITHMIC: np.geomspace}
"""Spacing of the values of an axis, by name."""


@dataclass(frozen=True)
class Axis:
    """Axis of a sweep: at each point, one number for all parameters in `along`, or a tuple with a number for each."""

    along: tuple[str, ...]
    values: tuple[float | tuple[float, ...], ...]


def axis(
    along: Sequence[str],
    range=None,
    values: int | None = None,
    scale: str = LINEAR,
    listed=None,
    cells: int | None = None,
    tuples=None,
) -> Axis:
    """Return the axis of one parameter, or of several that vary together.

    Give `range` with `values` or `cells`, or give `listed`, or `tuples`.

    Parameters
    ----------
    along
        Names of parameters of System.
    range
        Lower and upper end.
    values
        Number of points in `range`, both ends included.
    scale
        Spacing of these points, a key of SPACED.
    listed
        One number per point, for all parameters.
    cells
        Number of equal cells of `range`; the points are their midpoints.
    tuples
        For each point, one number per parameter.
    """
    if tuples is not None:
        return Axis(tuple(along), tuple(tuple(map(float, values)) for values in tuples))
    if listed is None:
        listed = centres(range, cells) if cells else SPACED[scale](*range, values)
    return Axis(tuple(along), tuple(float(value) for value in listed))


class Grid:
    """Points of a sweep: `system` with one or two axes of varied parameters; the last axis varies fastest."""

    def __init__(self, system: System, axes: Sequence[Axis]):
        self.base, self.axes = system, tuple(axes)
        self.shape = tuple(len(axis.values) for axis in self.axes)

    def __len__(self):
        return math.prod(self.shape)

    def place(self, number: int) -> dict[str, float]:
        """Return the value of each varied parameter by name, at a point."""
        place = {}
        for axis, k in zip(self.axes, np.unravel_index(number, self.shape), strict=True):
            place |= zip(axis.along, np.broadcast_to(axis.values[k], len(axis.along)).tolist(), strict=True)
        return place

    def system(self, number: int) -> System:
        """Return the system at a point.

        Raises
        ------
        ValueError
            If the system is not valid; the message names the point.
        """
        place = self.place(number)
        try:
            return self.base.with_(**place)
        except ValueError as error:
            where = ", ".join(f"{name} = {value:.6g}" for name, value in place.items())
            raise ValueError(f"at {where}: {error}") from None

    def tile(self, number: int, tiles: int) -> range:
        """Return every `tiles`-th point from point `number` - 1, so that all tiles take about the same time."""
        return range(number - 1, len(self), tiles)
