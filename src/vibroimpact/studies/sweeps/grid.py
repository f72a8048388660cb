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
    """Axis of a sweep, along which one or more parameters of System vary together.

    along: names of the parameters. values: for each point, one number that all these parameters get, or a tuple with
    one number per parameter.
    """

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

    Give the points by `range` and `values`, by `range` and `cells`, by `listed`, or by `tuples`.

    Parameters
    ----------
    along : sequence of str
        Names of the parameters of System.
    range : (float, float), optional
        Lower and upper end.
    values : int, optional
        Number of points from the lower to the upper end, both included.
    scale : str, default LINEAR
        Spacing of the `values` points, a key of SPACED.
    listed : sequence of float, optional
        One number per point; all parameters get this number.
    cells : int, optional
        Number of equal cells of the range; the points are the midpoints of the cells.
    tuples : sequence of sequences of float, optional
        For each point, one number per parameter.
    """
    if tuples is not None:
        return Axis(tuple(along), tuple(tuple(map(float, values)) for values in tuples))
    if listed is None:
        listed = centres(range, cells) if cells else SPACED[scale](*range, values)
    return Axis(tuple(along), tuple(float(value) for value in listed))


class Grid:
    """The points of a sweep, numbered from 0; the last axis varies fastest.

    Parameters
    ----------
    system
        System that gives the values of the parameters that no axis varies.
    axes : sequence of Axis
        One or two axes.
    """

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
            If the point does not give a valid system; the message names the point.
        """
        place = self.place(number)
        try:
            return self.base.with_(**place)
        except ValueError as error:
            where = ", ".join(f"{name} = {value:.6g}" for name, value in place.items())
            raise ValueError(f"at {where}: {error}") from None

    def tile(self, number: int, tiles: int) -> range:
        """Return the numbers of the points of a tile; tiles are counted from 1.

        A tile has every `tiles`-th point, so that all tiles take about the same time.
        """
        return range(number - 1, len(self), tiles)
