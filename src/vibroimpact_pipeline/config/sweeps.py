"""Section `sweeps`: questions of one's own, one or two parameters moved over a grid and what is observed there."""

import math
from itertools import product
from typing import Annotated, Literal

from pydantic import Field

from vibroimpact.sweeps.cost import core_seconds
from vibroimpact_pipeline.config.fields import CaseName, Number, items, named, span
from vibroimpact_pipeline.config.regimes import Cycles, Line, costs
from vibroimpact_pipeline.config.section import Section, above

POINTS = 4_000_000
"""Points of a sweep: its table is read and drawn in the memory of one job."""
LIMIT_HOURS = 1.0
"""Core hours that a sweep may take unless it says otherwise."""
_SIMULATED = ("starts", "seed", "cycles", "settle")
NEEDED = dict.fromkeys(("amplitudes", "envelopes", "energy"), _SIMULATED)
NEEDED |= {"regimes": ("starts", "seed"), "peaks": (*_SIMULATED, "band")}
"""What an observation needs to know."""
OBSERVATIONS = Literal["regimes", "amplitudes", "envelopes", "peaks", "energy", "fixed_points", "orbits"]
FORMS = [{"range", "values"}, {"range", "values", "scale"}, {"range", "cells"}, {"listed"}, {"tuples"}]
"""How an axis says its values."""
Count = Annotated[int, Field(ge=2, le=POINTS)]
Listed = items(Number, 2, 1000, "The values themselves, instead of all of these")
Tuple = items(Number, 2, 10, check=list)
Tuples = items(Tuple, 2, 1000, "Or a value for each parameter, the first never twice the same")


class Axis(Line):
    """Parameters that move together, evenly over a range, or through the values of a list."""

    range: span(Number) | None = None
    values: Count | None = Field(None, description="So many values over the range, both ends among them")
    cells: Count | None = Field(None, description="Or the middles of so many equal cells of the range")
    scale: Literal["linear", "logarithmic"] | None = Field(None, description="Of `values`; absent: linear")
    listed: Listed | None = None
    tuples: Tuples | None = None

    def conditions(self):
        said = {name for name in ("range", "values", "cells", "scale", "listed", "tuples") if getattr(self, name)}
        if said not in FORMS:
            forms = ", or ".join(" and ".join(sorted(form)) for form in FORMS)
            yield (), f"says its values by {', '.join(sorted(said)) or 'nothing'}, not by {forms}"
        elif self.tuples:
            firsts, lengths = {values[0] for values in self.tuples}, {len(values) for values in self.tuples}
            if len(firsts) < len(self.tuples) or lengths != {len(self.along)}:
                yield ("tuples",), f"need different first values, and {len(self.along)} values each"
        elif self.range:
            (low, high), logarithmic = self.range, self.scale == "logarithmic"
            if logarithmic and low <= 0:
                yield ("range", 0), f"{low} is not above 0, as on a logarithmic scale"
            elif (high - low) / self.number() < 4 * math.ulp(max(-low, high)):
                yield ("range",), f"{self.number()} values in {self.range} are not all different"

    def moves(self):
        """Return nothing: the parameters move together with those of the other axes of the sweep."""
        return ()

    def number(self) -> int:
        """Return the number of values."""
        return len(self.listed or self.tuples or ()) or self.cells or self.values

    def ends(self) -> list[dict[str, float]]:
        """Return the parameters at the least and the largest value, or at every tuple."""
        values = self.tuples or [[end] * len(self.along) for end in self.range or (min(self.listed), max(self.listed))]
        return [dict(zip(self.along, at, strict=True)) for at in values]


class Sweep(Section):
    """One or two axes, the case whose other parameters are kept, and what is observed at every point."""

    case: CaseName
    axes: items(Axis, 1, 2, "What moves over the grid")
    observe: items(OBSERVATIONS, 1, 7, "What is observed; the first five simulate, from every start")
    starts: int | None = Field(None, ge=1, le=10_000, description="Starts, spread evenly; the first is rest")
    seed: int | None = Field(None, ge=0, le=2**32 - 1, description="Scrambles the starts")
    cycles: Cycles | None = Field(None, description="Length of a run that is observed [forcing periods]")
    settle: int | None = Field(None, ge=0, le=1_000_000, description="Cycles of it that are left out [forcing periods]")
    band: Axis | None = Field(None, description="What moves at every point while the worst peak is sought")
    limit_hours: float = Field(LIMIT_HOURS, gt=0, le=1e6, description="A longer sweep is not begun [core hours]")

    def moving(self) -> list[Axis]:
        """Return all that moves."""
        return [*self.axes, *([self.band] if self.band else [])]

    def conditions(self):
        names = [name for axis in self.moving() for name in axis.along]
        if len(set(names)) < len(names):
            yield ("axes",), "a parameter moves along two of them or the band"
        needed = {name: observation for observation in self.observe for name in NEEDED.get(observation, ())}
        missing = [name for name in needed if getattr(self, name) is None]
        yield from (((name,), f"missing; {needed[name]} are observed in simulations") for name in missing)
        factors = {f"values of {' and '.join(axis.along)}": axis.number() for axis in self.moving()}
        yield from above(("axes",), POINTS, "points", **factors)
        if self.cycles is not None and self.settle is not None and self.settle >= self.cycles:
            yield ("settle",), f"{self.settle} leaves nothing of {self.cycles} cycles to observe"

    def moves(self):
        """Yield the corners of the grid; limits of parameters are intervals, so that these speak for all points."""
        for corner in product(*(axis.ends() for axis in self.moving())):
            yield {name: value for end in corner for name, value in end.items()}

    def costs(self, observation):
        """Yield what takes too long, or too much memory at one point."""
        asked = {**self.model_dump(exclude_none=True), "observation": dict(observation)}
        if (hours := core_seconds({"axes": asked["axes"], "asked": asked}) / 3600) > self.limit_hours:
            yield ("limit_hours",), f"it would take about {hours:.3g} core hours, above {self.limit_hours:g}"
        if "regimes" in self.observe:
            yield from costs(("starts",), self.starts, observation.cycles, observation.longest(), starts=self.starts)


FORCES = ["f10_hat", "f20_hat"]
_RESPONSE = ("amplitudes", "envelopes", "energy", "regimes")
DRAWN = {
    "regime_map": ("companion_regime_map", [FORCES[:1], FORCES[1:]], ("regimes", "fixed_points")),
    "frequency_response": ("companion_response", [["sigma_e_hat"], FORCES], _RESPONSE),
    "clearance": ("companion_absorber", [FORCES], ("peaks", *_RESPONSE)),
    "design": ("companion_absorber", [["kappa"], FORCES], ("peaks",)),
}
"""Sweeps that companion figures draw: which figure, what moves along each axis, and what has to be observed."""
SPREAD_EVENLY = "regime_map"
Sweeps = named(Sweep, 0, 100)


def not_drawn(sweeps: dict[str, Sweep]):
    """Yield what the sweeps that companion figures draw lack."""
    for name in DRAWN.keys() & sweeps.keys():
        (figure, along, observe), sweep = DRAWN[name], sweeps[name]
        uneven = name == SPREAD_EVENLY and not all(axis.range and axis.scale != "logarithmic" for axis in sweep.axes)
        if uneven or [axis.along for axis in sweep.axes] != along:
            yield (name, "axes"), f"are not {along}, {'evenly, ' * uneven}as {figure} draws it; take another name"
        if missing := [wanted for wanted in observe if wanted not in sweep.observe]:
            yield (name, "observe"), f"{' and '.join(missing)} missing, which {figure} draws; take another name"
