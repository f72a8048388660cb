"""Section `report`: what moves in the report."""

from pydantic import Field

from vibroimpact_pipeline.config.fields import Amplitude, CaseName, Forces, named
from vibroimpact_pipeline.config.section import Section

FINEST = 1e-6
"""Least distance of values: they are written with six decimals."""


class Animation(Section):
    """The first cycles of a case's simulated window."""

    case: CaseName
    cycles: int = Field(ge=1, le=1000, description="Cycles shown, no more than the window has [forcing periods]")


class ForceSweep(Section):
    """The control on the page of fixed points: f20_hat changes, the rest is as in the case."""

    case: CaseName
    range: Forces
    values: int = Field(ge=2, le=1000, description="Values of f20_hat")
    C_max: Amplitude = Field(description="Right end of the planes")

    def conditions(self):
        if (step := (self.range[1] - self.range[0]) / (self.values - 1)) < FINEST:
            yield ("values",), f"{self.values} values are {step:.2g} apart, less than {FINEST:g}"


class Report(Section):
    """Animations, and the control that moves the fixed points."""

    animations: named(Animation, 1, 10) = Field(description="Animations by free names")
    force_sweep: ForceSweep
