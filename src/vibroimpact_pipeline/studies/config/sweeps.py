"""Section `sweeps`: your own parameter studies, one or two axes and the observations at each point."""

import math
from collections import ChainMap
from itertools import product
from typing import Literal

from pydantic import Field

from vibroimpact_pipeline.config import fields
from vibroimpact_pipeline.config.section import Section
from vibroimpact_pipeline.specs import specs
from vibroimpact_pipeline.studies.config.regimes import Along

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
Listed = fields.items(fields.Number, 2, fields.MOST, "The values themselves, instead of all of these")
Tuple = fields.items(fields.Number, 2, 10, check=None)
Tuples = fields.items(Tuple, 2, 100, "Or a value for each parameter, the first never twice the same")


class Axis(Section):
    """Parameters that move together, evenly over a range or through a list."""

    along: Along
    range: fields.span(fields.Number) | None = None
    values: fields.count("So many values over the range, both ends among them", 2, POINTS) | None = None
    cells: fields.count("Or the middles of so many equal cells of the range", 2, POINTS) | None = None
    scale: Literal["linear", "logarithmic"] | None = Field(None, description="Of `values`; absent: linear")
    listed: Listed | None = None
    tuples: Tuples | None = None

    def conditions(self):
        given = {name for name, value in self if value and name != "along"}
        if given not in FORMS:
            forms = ", or ".join(" and ".join(sorted(form)) for form in FORMS)
            yield (), f"should have {forms}, not {', '.join(sorted(given)) or 'none of these'}"
        elif self.tuples:
            firsts, lengths = {values[0] for values in self.tuples}, {len(values) for values in self.tuples}
            if len(firsts) < len(self.tuples) or lengths != {len(self.along)}:
                yield ("tuples",), f"should have different first values, and {len(self.along)} values each"
        elif self.range:
            low, high = self.range
            if low <= 0 and self.scale == "logarithmic":
                yield ("range", 0), f"{low} should be above 0, as on a logarithmic scale"
            elif (high - low) / self.number() < 4 * math.ulp(max(-low, high)):
                yield ("range",), f"{self.range} should have {self.number()} different values"

    def number(self) -> int:
        """Return the number of values."""
        return len(self.listed or self.tuples or ()) or self.cells or self.values

    def ends(self) -> list[dict[str, float]]:
        """Return the parameters at the least and the largest value, or at every tuple."""
        values = self.tuples or [[end] * len(self.along) for end in self.range or (min(self.listed), max(self.listed))]
        return [dict(zip(self.along, at, strict=True)) for at in values]


class Sweep(Section):
    """One or two axes, the case with the other parameters, and the observations at every point."""

    case: fields.CaseName
    axes: fields.items(Axis, 1, 2, "What moves over the grid")
    observe: fields.items(OBSERVATIONS, 1, 7, "What is observed; the first five simulate, from every start")
    starts: fields.Starts | None = None
    seed: fields.Seed | None = None
    cycles: fields.count("Length of a run that is observed [forcing periods]") | None = None
    settle: fields.count("Cycles of it that are left out; see docs/howto.md [forcing periods]", 0) | None = None
    band: Axis | None = Field(None, description="What moves at every point while the worst peak is sought")

    def moving(self) -> list[Axis]:
        """Return the axes and the band."""
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
        if None not in (self.cycles, self.settle) and self.settle >= self.cycles:
            yield ("settle",), f"{self.settle} should be less than cycles"

    def corners(self) -> list[dict[str, float]]:
        """Return the parameters at the corners of the grid; their limits are intervals, so corners are enough."""
        return [dict(ChainMap(*ends)) for ends in product(*(axis.ends() for axis in self.moving()))]

    def not_drawn(self, name: str):
        """Yield entries that a sweep lacks for the companion figures that draw it ("sweeps" in their SPEC)."""
        for figure, spec in specs().items():
            if drawn := spec.get("sweeps", {}).get(name):
                even = all(axis.range and axis.scale != "logarithmic" for axis in self.axes)
                if [axis.along for axis in self.axes] != drawn["along"] or (drawn.get("evenly") and not even):
                    how = ", evenly" if drawn.get("evenly") else ""
                    yield ("axes",), f"are not {drawn['along']}{how}, as {figure} draws it; take another name"
                if missing := [wanted for wanted in drawn["observe"] if wanted not in self.observe]:
                    yield ("observe",), f"{' and '.join(missing)} missing, which {figure} draws; take another name"
