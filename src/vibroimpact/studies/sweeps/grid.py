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

    along: names of the parameters.
    values: one entry per point of the axis. An entry is one number for all parameters, or a tuple with one number per
    parameter.
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
    """Return the axis along which one parameter varies, or several parameters vary together.

    There are four ways to give the points: `range` and `values`, `range` and `cells`, `listed`, or `tuples`.

    Parameters
    ----------
    along
        Names of the parameters of System.
    range
        Lower and upper end of the axis.
    values
        Number of points from the lower end to the upper end. Both ends are points.
    scale
        Spacing of the points that `range` and `values` give, a key of SPACED.
    listed
        List with one number per point. All parameters get this number.
    cells
        Number of equal cells of `range`. The midpoints of the cells are the points.
    tuples
        List with one tuple per point. A tuple has one number per parameter.
    """
    if tuples is not None:
        return Axis(tuple(along), tuple(tuple(map(float, values)) for values in tuples))
    if listed is None:
        listed = centres(range, cells) if cells else SPACED[scale](*range, values)
    return Axis(tuple(along), tuple(float(value) for value in listed))


class Grid:
    """Points of a sweep, numbered from 0; the last axis varies fastest.

    system: system whose parameters are used unless an axis varies them.
    axes: one or two axes.
    """

    def __init__(self, system: System, axes: Sequence[Axis]):
        self.base, self.axes = system, tuple(axes)
        self.shape = tuple(len(axis.values) for axis in self.axes)

    def __len__(self):
        return math.prod(self.shape)

    def place(self, number: int) -> dict[str, float]:
        """Return the values of the varied parameters at the point with this number, by name of the parameter."""
        place = {}
        for axis, k in zip(self.axes, np.unravel_index(number, self.shape), strict=True):
            place |= zip(axis.along, np.broadcast_to(axis.values[k], len(axis.along)).tolist(), strict=True)
        return place

    def system(self, number: int) -> System:
        """Return the system at the point with this number.

        Raises
        ------
        ValueError
            If the point does not give a valid system. The message names the values of the varied parameters.
        """
        place = self.place(number)
        try:
            return self.base.with_(**place)
        except ValueError as error:
            where = ", ".join(f"{name} = {value:.6g}" for name, value in place.items())
            raise ValueError(f"at {where}: {error}") from None

    def tile(self, number: int, tiles: int) -> range:
        """Return the numbers of the points in tile `number`, which is counted from 1.

        Points are dealt to the `tiles` tiles in turn, so that all tiles take about the same time.
        """
        return range(number - 1, len(self), tiles)
