"""Section `sweeps`: parameter sweeps along one or two axes, with observations at each point."""

import math
from collections import ChainMap
from itertools import product
from typing import Literal

from pydantic import Field

from vibroimpact.studies.sweeps.cost import RUNS
from vibroimpact_pipeline.config import fields
from vibroimpact_pipeline.config.section import Section
from vibroimpact_pipeline.specs import specs
from vibroimpact_pipeline.studies.config.regimes import Along

MAX_POINTS = 4_000_000
"""Maximum number of points of a sweep, since one job keeps the whole table in memory."""
SIMULATED = ("starts", "seed", "cycles", "settle")
NEEDED = dict.fromkeys(RUNS, SIMULATED) | {"regimes": ("starts", "seed"), "peaks": (*SIMULATED, "band")}
"""For each observation that needs further keys of the sweep, these keys."""
OBSERVATIONS = Literal["regimes", "amplitudes", "peaks", "energy", "fixed_points"]
FORMS = [{"range", "values"}, {"range", "values", "scale"}, {"range", "cells"}, {"listed"}, {"tuples"}]
"""Allowed combinations of keys that define the values of an axis."""
Listed = fields.items(fields.Number, 2, fields.MAX_VALUES, "Values, instead of a range")
Tuple = fields.items(fields.Number, 2, 10, check=None)
Tuples = fields.items(
    Tuple, 2, 100, "Tuples with one value for each parameter, instead of a range; first values must differ"
)


class Axis(Section):
    """One axis of a sweep: parameters that vary together, over a range or a list of values."""

    along: Along
    range: fields.span(fields.Number) | None = None
    values: fields.count("Number of values over the range, endpoints included", 2, MAX_POINTS) | None = None
    cells: fields.count("Number of equal cells of the range, whose centres are the values", 2, MAX_POINTS) | None = None
    scale: Literal["linear", "logarithmic"] | None = Field(None, description="Spacing of `values`; default: linear")
    listed: Listed | None = None
    tuples: Tuples | None = None

    def conditions(self):
        given = {name for name, value in self if value and name != "along"}
        if given not in FORMS:
            forms = ", or ".join(" and ".join(sorted(form)) for form in FORMS)
            yield (), f"should have the keys {forms}; has {', '.join(sorted(given)) or 'none of these'}"
        elif self.tuples:
            firsts, lengths = {values[0] for values in self.tuples}, {len(values) for values in self.tuples}
            if len(firsts) < len(self.tuples) or lengths != {len(self.along)}:
                yield ("tuples",), f"should have {len(self.along)} values each, and different first values"
        elif self.range:
            low, high = self.range
            if low <= 0 and self.scale == "logarithmic":
                yield ("range", 0), f"{low} should be above 0 for a logarithmic scale"
            elif (high - low) / self.number() < 4 * math.ulp(max(-low, high)):
                yield ("range",), f"{self.range} should be wide enough for {self.number()} different values"

    def number(self) -> int:
        """Return the number of values of the axis."""
        return len(self.listed or self.tuples or ()) or self.cells or self.values

    def ends(self) -> list[dict[str, float]]:
        """Return the parameters at both ends of the axis. If the axis has `tuples`, return those of every tuple."""
        values = self.tuples or [[end] * len(self.along) for end in self.range or (min(self.listed), max(self.listed))]
        return [dict(zip(self.along, at, strict=True)) for at in values]


class Sweep(Section):
    """A sweep: one or two axes, a case with the parameters that do not vary, and the observations at every point."""

    case: fields.CaseName
    axes: fields.items(Axis, 1, 2, "Axes of the grid")
    observe: fields.items(OBSERVATIONS, 1, 5, "Observations; all but fixed_points need simulations")
    starts: fields.Starts | None = None
    seed: fields.Seed | None = None
    cycles: fields.count("Length of a run [forcing periods]") | None = None
    settle: fields.count("Length of the discarded transient, see docs/howto.md [forcing periods]", 0) | None = None
    band: Axis | None = Field(None, description="Axis along which the worst peak is searched at every point")

    def moving(self) -> list[Axis]:
        """Return the axes of the grid and, if given, the axis `band`."""
        return self.axes + ([self.band] if self.band else [])

    def conditions(self):
        names = [name for axis in self.moving() for name in axis.along]
        if len(set(names)) < len(names):
            yield ("axes",), "a parameter should vary along one axis or the band only"
        if math.prod(axis.number() for axis in self.moving()) > MAX_POINTS:
            yield ("axes",), f"should have at most {MAX_POINTS} points, including those of the band"
        needed = {name: observation for observation in self.observe for name in NEEDED.get(observation, ())}
        for name in (name for name in needed if getattr(self, name) is None):
            yield (name,), f"missing; required to observe {needed[name]}"
        if None not in (self.cycles, self.settle) and self.settle >= self.cycles:
            yield ("settle",), f"{self.settle} should be less than cycles"

    def corners(self) -> list[dict[str, float]]:
        """Return the parameters at all corners of the grid.

        If the sweep has the key `band`, the band counts as a further axis of the grid. If a parameter is within its
        limits at all corners, it is within these limits everywhere.
        """
        return [dict(ChainMap(*ends)) for ends in product(*(axis.ends() for axis in self.moving()))]

    def not_drawn(self, name: str):
        """Yield a pair (key path, message) for each reason why companion figures cannot draw the sweep `name`."""
        for figure, spec in specs().items():
            if drawn := spec.get("sweeps", {}).get(name):
                even = all(axis.range and axis.scale != "logarithmic" for axis in self.axes)
                if [axis.along for axis in self.axes] != drawn["along"] or (drawn.get("evenly") and not even):
                    how = ", evenly spaced" if drawn.get("evenly") else ""
                    what = f"should be {drawn['along']}{how}, as {figure} draws this sweep; or rename the sweep"
                    yield ("axes",), what
                if missing := [wanted for wanted in drawn["observe"] if wanted not in self.observe]:
                    what = f"should contain {' and '.join(missing)}, which {figure} draws; or rename the sweep"
                    yield ("observe",), what
