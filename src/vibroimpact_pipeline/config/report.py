"""Section `report`: what moves in the report."""

from typing import Annotated

from pydantic import Field

from vibroimpact_pipeline.config.fields import Amplitude, CaseName, ForceRange, Name, not_ascending, unit
from vibroimpact_pipeline.config.section import Change, Problem, Section

FINEST = 1e-6
"""Least distance of values: they are written with six decimals."""


class Animation(Section):
    """The first cycles of a case's simulated window."""

    case: CaseName
    cycles: Annotated[int, Field(ge=1, le=1000)] = Field(
        description="Cycles shown, no more than the window has", json_schema_extra=unit("forcing periods")
    )


class ForceSweep(Section):
    """The control on the page of fixed points: f20_hat changes, the rest is as in the case."""

    case: CaseName
    range: ForceRange
    values: Annotated[int, Field(ge=2, le=1000)] = Field(description="Values of f20_hat")
    C_max: Amplitude = Field(description="Right end of the planes")

    def conditions(self):
        yield from not_ascending("range", self.range)
        step = (self.range[1] - self.range[0]) / (self.values - 1)
        if 0 < step < FINEST:
            yield Problem(("values",), f"{self.values} values are {step:.2g} apart, less than {FINEST:g}")

    def changes(self):
        yield Change(("range",), self.case, ["f20_hat"], self.range)


class Report(Section):
    """Animations, and the control that moves the fixed points."""

    animations: Annotated[dict[Name, Animation], Field(min_length=1, max_length=10)]
    force_sweep: ForceSweep
