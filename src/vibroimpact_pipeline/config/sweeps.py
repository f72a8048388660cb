"""Section `sweeps`: your own parameter studies, one or two axes and the observations at each point."""

import math
from itertools import product
from typing import Annotated, ClassVar, Literal

from pydantic import Field

from vibroimpact.sweeps.cost import core_seconds
from vibroimpact_pipeline.config import kinds
from vibroimpact_pipeline.config.regimes import DEAR, Along, affordable
from vibroimpact_pipeline.config.section import Section

POINTS = 4_000_000
"""Points of a sweep: its table is read and drawn in the memory of one job."""
SIMULATED = ("starts", "seed", "cycles", "settle")
NEEDED = dict.fromkeys(("amplitudes", "envelopes", "energy"), SIMULATED) | {
    "regimes": ("starts", "seed"),
    "peaks": (*SIMULATED, "band"),
}
"""Keys required by each observation."""
OBSERVATIONS = Literal["regimes", "amplitudes", "envelopes", "peaks", "energy", "fixed_points", "orbits"]
FORMS = [{"range", "values"}, {"range", "values", "scale"}, {"range", "cells"}, {"listed"}, {"tuples"}]
"""Keys by which an axis may give its values."""
Count = Annotated[int, Field(ge=2, le=POINTS)]
Listed = kinds.items(kinds.Number, 2, 1000, "The values themselves, instead of all of these")
Tuple = kinds.items(kinds.Number, 2, 10, check=None)
Tuples = kinds.items(Tuple, 2, 1000, "Or a value for each parameter, the first never twice the same")


class Axis(Section):
    """Parameters that move together, evenly over a range or through a list."""

    along: Along
    range: kinds.span(kinds.Number) | None = None
    values: Count | None = Field(None, description="So many values over the range, both ends among them")
    cells: Count | None = Field(None, description="Or the middles of so many equal cells of the range")
    scale: Literal["linear", "logarithmic"] | None = Field(None, description="Of `values`; absent: linear")
    listed: Listed | None = None
    tuples: Tuples | None = None

    def conditions(self):
        said = {name for name, value in self if value and name != "along"}
        if said not in FORMS:
            forms = ", or ".join(" and ".join(sorted(form)) for form in FORMS)
            yield (), f"says its values by {', '.join(sorted(said)) or 'nothing'}, not by {forms}"
        elif self.tuples:
            firsts, lengths = {values[0] for values in self.tuples}, {len(values) for values in self.tuples}
            if len(firsts) < len(self.tuples) or lengths != {len(self.along)}:
                yield ("tuples",), f"need different first values, and {len(self.along)} values each"
        elif self.range:
            low, high = self.range
            if low <= 0 and self.scale == "logarithmic":
                yield ("range", 0), f"{low} is not above 0, as on a logarithmic scale"
            elif (high - low) / self.number() < 4 * math.ulp(max(-low, high)):
                yield ("range",), f"{self.number()} values in {self.range} are not all different"

    def number(self) -> int:
        """Return the number of values."""
        return len(self.listed or self.tuples or ()) or self.cells or self.values

    def ends(self) -> list[dict[str, float]]:
        """Return the parameters at the least and the largest value, or at every tuple."""
        values = self.tuples or [[end] * len(self.along) for end in self.range or (min(self.listed), max(self.listed))]
        return [dict(zip(self.along, at, strict=True)) for at in values]


class Sweep(Section):
    """One or two axes, the case with the other parameters, and the observations at every point."""

    case: kinds.CaseName
    axes: kinds.items(Axis, 1, 2, "What moves over the grid")
    observe: kinds.items(OBSERVATIONS, 1, 7, "What is observed; the first five simulate, from every start")
    starts: int | None = Field(None, ge=1, le=10_000, description="Starts, spread evenly; the first is rest")
    seed: int | None = Field(None, ge=0, le=2**32 - 1, description="Scrambles the starts")
    cycles: kinds.Cycles | None = Field(None, description="Length of a run that is observed [forcing periods]")
    settle: int | None = Field(None, ge=0, le=1_000_000, description="Cycles of it that are left out [forcing periods]")
    band: Axis | None = Field(None, description="What moves at every point while the worst peak is sought")
    limit_hours: float = Field(1.0, gt=0, le=1e6, description="A longer sweep is not begun [core hours]")

    rules: ClassVar = [("settle", "cycles is None or settle is None or settle < cycles")]

    def moving(self) -> list[Axis]:
        """Return the names of all moving parameters."""
        return self.axes + ([self.band] if self.band else [])

    def conditions(self):
        names = [name for axis in self.moving() for name in axis.along]
        if len(set(names)) < len(names):
            yield ("axes",), "a parameter moves along two of them or the band"
        if math.prod(axis.number() for axis in self.moving()) > POINTS:
            yield ("axes",), f"more than {POINTS} points, with those of the band"
        needed = {name: observation for observation in self.observe for name in NEEDED.get(observation, ())}
        for name in (name for name in needed if getattr(self, name) is None):
            yield (name,), f"missing; {needed[name]} are observed in simulations"
        yield from super().conditions()

    def moves(self):
        """Yield the corners of the grid; limits of parameters are intervals, so corners are enough."""
        for corner in product(*(axis.ends() for axis in self.moving())):
            yield {name: value for end in corner for name, value in end.items()}

    def costs(self, observation):
        """Yield problems of points that take too long or too much memory."""
        spec = {**self.model_dump(exclude_none=True), "observation": dict(observation)}
        if (hours := core_seconds({"axes": spec["axes"], "spec": spec}) / 3600) > self.limit_hours:
            yield ("limit_hours",), f"it would take about {hours:.3g} core hours, above {self.limit_hours:g}"
        if "regimes" in self.observe and not affordable(observation, self.starts):
            yield ("starts",), f"{self.starts} {DEAR}"
