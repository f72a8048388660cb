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

POINTS = 4_000_000
"""Points of a sweep: its table is read and drawn in the memory of one job."""
LIMIT_HOURS = 1.0
"""Core hours that a sweep may take unless it says otherwise."""
_SIMULATED = ("starts", "seed", "cycles", "settle")
NEEDED = {
    "regimes": ("starts", "seed"),
    "amplitudes": _SIMULATED,
    "envelopes": _SIMULATED,
    "peaks": (*_SIMULATED, "band"),
    "energy": _SIMULATED,
}
"""What an observation needs to know."""


class Axis(Line):
    """Parameters that move together, evenly over a range, or through the values of a list."""

    range: Annotated[list[Number], Field(min_length=2, max_length=2)] = Field(
        default=None, description="Where they begin and end; without it `listed` says where they are"
    )
    values: Annotated[int, Field(ge=2, le=POINTS)] = Field(
        default=None, description="So many values over the range, both ends among them"
    )
    cells: Annotated[int, Field(ge=2, le=POINTS)] = Field(
        default=None, description="Instead of `values`: the middles of so many equal cells of the range"
    )
    scale: Literal["linear", "logarithmic"] = Field(
        default=None, description="How `values` are spaced; linear unless said"
    )
    listed: Annotated[list[Number], Field(min_length=2, max_length=1000)] = Field(
        default=None, description="The values themselves, instead of all of these"
    )
    tuples: Annotated[
        list[Annotated[list[Number], Field(min_length=2, max_length=10)]], Field(min_length=2, max_length=1000)
    ] = Field(
        default=None, description="Instead of `listed`: a value for each parameter, the first never twice the same"
    )

    def conditions(self):
        yield from super().conditions()
        stated = next((name for name in ("listed", "tuples") if getattr(self, name) is not None), None)
        for name in ("range", "values", "cells", "scale", "tuples") if stated else ():
            if name != stated and getattr(self, name) is not None:
                yield Problem((name,), f"stands beside `{stated}`, which says all; leave one of them out")
        if stated is None:
            yield from self._spaced()
        elif stated == "listed":
            yield from repeated("listed", self.listed)
        else:
            yield from self._tuples()

    def _tuples(self):
        yield from repeated("tuples", [values[0] for values in self.tuples])
        for place, values in enumerate(self.tuples):
            if len(values) != len(self.along):
                yield Problem(("tuples", place), f"{values} has {len(values)} values for {len(self.along)} parameters")

    def _spaced(self):
        number = "values" if self.cells is None else "cells"
        for name in ("range", number):
            if getattr(self, name) is None:
                yield Problem((name,), "missing; an axis has `range` and `values` or `cells`, or `listed`")
        if self.cells is not None:
            for name in ("values", "scale"):
                if getattr(self, name) is not None:
                    yield Problem((name,), "stands beside `cells`, which says all; leave one of them out")
        if self.range is None or (self.values is None and self.cells is None):
            return
        yield from (descending := not_ascending("range", self.range))
        if not descending and self.scale == LOGARITHMIC and self.range[0] <= 0:
            yield Problem(("range", 0), f"{self.range[0]} is not above 0, as on a logarithmic scale")
        elif not descending and len(set(self.points())) < self.number():
            yield Problem((number,), f"{self.number()} values in {self.range} are not all different")

    def points(self) -> tuple[float, ...]:
        """The values, in their order."""
        return grid.axis(**self.model_dump(exclude_none=True)).values

    def ends(self) -> dict[float | tuple, tuple]:
        """Least and largest value, or every tuple, each with its place in the axis."""
        if self.tuples is not None:
            return {tuple(values): ("tuples", place) for place, values in enumerate(self.tuples)}
        if self.listed is None:
            return {value: ("range", k) for k, value in enumerate(self.range)}
        return {value: ("listed", self.listed.index(value)) for value in (min(self.listed), max(self.listed))}

    def at(self, value) -> dict[str, float]:
        """The parameters at a value, or at a tuple."""
        return grid.Axis(tuple(self.along), ()).place(value)

    def number(self) -> int:
        return len(self.listed or self.tuples or ()) or self.cells or self.values


class Sweep(Section):
    """One or two axes, the case whose other parameters are kept, and what is observed at every point."""

    case: CaseName
    axes: Annotated[list[Axis], Field(min_length=1, max_length=2)]
    observe: Annotated[
        list[Literal["regimes", "amplitudes", "envelopes", "peaks", "energy", "fixed_points", "orbits"]],
        Field(min_length=1, max_length=7),
    ] = Field(description="What is observed; the first five simulate, from every start")
    starts: Starts = None
    seed: Seed = None
    cycles: Cycles = Field(default=None, description="Length of a run whose amplitudes are observed")
    settle: Annotated[int, Field(ge=0, le=1_000_000)] = Field(
        default=None, description="Cycles of it that are left out", json_schema_extra=unit("forcing periods")
    )
    band: Axis = Field(default=None, description="What moves at every point while peaks are sought: the worst is told")
    limit_hours: Annotated[float, Field(gt=0, le=1e6)] = Field(
        default=LIMIT_HOURS,
        description="A sweep that would take longer, by what a few of its points take, is not begun",
        json_schema_extra=unit("core hours"),
    )

    def conditions(self):
        yield from repeated("observe", self.observe)
        moved = {}
        for (place, axis), which in zip(self.moving().items(), ("the first axis", "the second axis", ""), strict=False):
            for number, name in enumerate(axis.along):
                if name in moved:
                    yield Problem((*place, "along", number), f"{name} moves along {moved[name]} already")
            moved |= dict.fromkeys(axis.along, which)
        yield from self._missing()
        points = {"values of axis 1": self.axes[0].number()}
        points |= {"values of axis 2": self.axes[1].number()} if len(self.axes) == 2 else {}
        points |= {"values of the band": self.band.number()} if self.band else {}
        yield from above(("axes",), POINTS, "points", **points)
        if self.cycles is not None and self.settle is not None and self.settle >= self.cycles:
            yield Problem(("settle",), f"{self.settle} leaves nothing of {self.cycles} cycles to observe")

    def moving(self) -> dict[tuple, Axis]:
        """All that moves, by its place."""
        band = {("band",): self.band} if self.band else {}
        return {("axes", number): axis for number, axis in enumerate(self.axes)} | band

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
        found, axes = {}, self.moving()
        for corner in product(*(axis.ends().items() for axis in axes.values())):
            ends = zip(axes.values(), corner, strict=True)
            moved = {name: value for axis, (end, _) in ends for name, value in axis.at(end).items()}
            where = ", ".join(f"{name} = {value:g}" for name, value in moved.items())
            for (*name,), what in unsound(parameters | moved):
                found.setdefault(self._place(corner, name), f"at {where}: {': '.join([*name[:1], what])}")
        for place, what in found.items():
            yield Problem(place, what)

    def _place(self, corner, name):
        """The end of the axis that a parameter moves along, of the first axis where it does not move."""
        axes = self.moving()
        along = [k for k, axis in enumerate(axes.values()) if name and name[0] in axis.along]
        k = along[0] if along else 0
        return (*list(axes)[k], *corner[k][1])


FORCES = ("f10_hat", "f20_hat")
_RESPONSE = ("amplitudes", "envelopes", "energy", "regimes")
DRAWN = {
    "regime_map": ("companion_regime_map", [FORCES[:1], FORCES[1:]], ("regimes", "fixed_points")),
    "frequency_response": ("companion_response", [("sigma_e_hat",), FORCES], _RESPONSE),
    "clearance": ("companion_absorber", [FORCES], ("peaks", *_RESPONSE)),
    "design": ("companion_absorber", [("kappa",), FORCES], ("peaks",)),
}
"""Sweeps that companion figures draw: which figure, what moves along each axis, and what has to be observed."""
SPREAD_EVENLY = "regime_map"

Sweeps = Annotated[
    dict[Name, Sweep],
    Field(
        max_length=100, description=f"Sweeps by name; a build makes {', '.join(DRAWN)}, which companion figures draw"
    ),
]


def not_drawn(sweeps: Sweeps) -> Iterator[Problem]:
    """What the sweeps that companion figures draw lack."""
    for name in DRAWN.keys() & sweeps.keys():
        figure, along, observe = DRAWN[name]
        other = f"as {figure} draws it; another question takes another name"
        if not _along(sweeps[name].axes, along, even=name == SPREAD_EVENLY):
            words = " and ".join(", ".join(names) for names in along)
            yield Problem(
                (name, "axes"), f"are not {words}{', evenly over a range each' * (name == SPREAD_EVENLY)}, {other}"
            )
        if missing := [wanted for wanted in observe if wanted not in sweeps[name].observe]:
            yield Problem((name, "observe"), f"{' and '.join(missing)} missing, {other}")


def _along(axes, along, even):
    """Whether parameters move along axes in this order, and where it has to be `even`, evenly."""
    if [tuple(axis.along) for axis in axes] != along:
        return False
    return not (even and any(axis.listed or axis.tuples or axis.scale == LOGARITHMIC for axis in axes))
