"""Section `sweeps`: questions of one's own, one or two parameters moved over a grid and what is observed there."""

from collections.abc import Iterator
from itertools import product
from typing import Annotated, Literal

from pydantic import Field

from vibroimpact.sweeps import grid
from vibroimpact.sweeps.grid import LOGARITHMIC
from vibroimpact_pipeline.config.cost import above
from vibroimpact_pipeline.config.fields import CaseName, Name, Number, Seed, Starts, not_ascending, repeated, unit
from vibroimpact_pipeline.config.regimes import Cycles, Line, costs
from vibroimpact_pipeline.config.section import Problem, Section
from vibroimpact_pipeline.config.system import unsound

POINTS = 1_000_000
"""Points of a sweep: its table is read and drawn in the memory of one job."""
LIMIT_HOURS = 1.0
"""Core hours that a sweep may take unless it says otherwise."""
NEEDED = {"regimes": ("starts", "seed"), "amplitudes": ("starts", "seed", "cycles", "settle")}
"""What an observation needs to know."""


class Axis(Line):
    """Parameters that move together, evenly over a range, or through the values of a list."""

    range: Annotated[list[Number], Field(min_length=2, max_length=2)] = Field(
        default=None, description="Where they begin and end; without it `listed` says where they are"
    )
    values: Annotated[int, Field(ge=2, le=POINTS)] = Field(
        default=None, description="So many values over the range, both ends among them"
    )
    scale: Literal["linear", "logarithmic"] = Field(default=None, description="How they are spaced; linear unless said")
    listed: Annotated[list[Number], Field(min_length=2, max_length=1000)] = Field(
        default=None, description="The values themselves, instead of `range`, `values` and `scale`"
    )

    def conditions(self):
        yield from super().conditions()
        if self.listed is not None:
            yield from repeated("listed", self.listed)
            for name in ("range", "values", "scale"):
                if getattr(self, name) is not None:
                    yield Problem((name,), "stands beside `listed`, which says all; leave one of them out")
        else:
            yield from self._spaced()

    def _spaced(self):
        for name in ("range", "values"):
            if getattr(self, name) is None:
                yield Problem((name,), "missing; an axis has `range` and `values`, or `listed`")
        if self.range is None or self.values is None:
            return
        yield from (descending := not_ascending("range", self.range))
        if not descending and self.scale == LOGARITHMIC and self.range[0] <= 0:
            yield Problem(("range", 0), f"{self.range[0]} is not above 0, as on a logarithmic scale")
        elif not descending and len(set(self.points())) < self.values:
            yield Problem(("values",), f"{self.values} values in {self.range} are not all different")

    def points(self) -> tuple[float, ...]:
        """The values, in their order."""
        return grid.axis(**self.model_dump(exclude_none=True)).values

    def ends(self) -> dict[float, tuple]:
        """Least and largest value, each with its place in the axis."""
        if self.listed is None:
            return {value: ("range", k) for k, value in enumerate(self.range)}
        return {value: ("listed", self.listed.index(value)) for value in (min(self.listed), max(self.listed))}

    def number(self) -> int:
        return len(self.listed or ()) or self.values


class Sweep(Section):
    """One or two axes, the case whose other parameters are kept, and what is observed at every point."""

    case: CaseName
    axes: Annotated[list[Axis], Field(min_length=1, max_length=2)]
    observe: Annotated[
        list[Literal["regimes", "amplitudes", "fixed_points", "orbits"]], Field(min_length=1, max_length=4)
    ] = Field(description="What is observed; the first two simulate, from every start")
    starts: Starts = None
    seed: Seed = None
    cycles: Cycles = Field(default=None, description="Length of a run whose amplitudes are observed")
    settle: Annotated[int, Field(ge=0, le=1_000_000)] = Field(
        default=None, description="Cycles of it that are left out", json_schema_extra=unit("forcing periods")
    )
    limit_hours: Annotated[float, Field(gt=0, le=1e6)] = Field(
        default=LIMIT_HOURS,
        description="A sweep that would take longer, by what a few of its points take, is not begun",
        json_schema_extra=unit("core hours"),
    )

    def conditions(self):
        yield from repeated("observe", self.observe)
        first = self.axes[0].along
        for number, name in enumerate(self.axes[-1].along):
            if len(self.axes) == 2 and name in first:
                yield Problem(("axes", 1, "along", number), f"{name} moves along the first axis already")
        yield from self._missing()
        points = {"values of axis 1": self.axes[0].number()}
        points |= {"values of axis 2": self.axes[1].number()} if len(self.axes) == 2 else {}
        yield from above(("axes",), POINTS, "points", **points)
        if self.cycles is not None and self.settle is not None and self.settle >= self.cycles:
            yield Problem(("settle",), f"{self.settle} leaves nothing of {self.cycles} cycles to observe")

    def _missing(self):
        """What an observation needs and is not said."""
        needed = {name: observation for observation in self.observe for name in NEEDED.get(observation, ())}
        for name, observation in needed.items():
            if getattr(self, name) is None:
                yield Problem((name,), f"missing; {observation} are observed in simulations")

    def costs(self, observation) -> Iterator[Problem]:
        """What is too much at one point, where regimes are observed for as long as `regimes.observation` says."""
        if "regimes" in self.observe:
            yield from costs(("starts",), self.starts, observation.cycles, observation.longest(), starts=self.starts)

    def unsound_corners(self, parameters: dict) -> Iterator[Problem]:
        """Corners of the grid where a parameter leaves its limits, one problem for each end of an axis."""
        found = {}
        for corner in product(*(axis.ends().items() for axis in self.axes)):
            moved = {name: value for axis, (value, _) in zip(self.axes, corner, strict=True) for name in axis.along}
            where = ", ".join(f"{name} = {value:g}" for name, value in moved.items())
            for (*name,), what in unsound(parameters | moved):
                found.setdefault(self._place(corner, name), f"at {where}: {': '.join([*name[:1], what])}")
        for place, what in found.items():
            yield Problem(place, what)

    def _place(self, corner, name):
        """The end of the axis that a parameter moves along, of the first axis where it does not move."""
        along = [k for k, axis in enumerate(self.axes) if name and name[0] in axis.along]
        k = along[0] if along else 0
        return ("axes", k, *corner[k][1])


Sweeps = Annotated[dict[Name, Sweep], Field(max_length=100, description="Sweeps by name, of which a build makes none")]
