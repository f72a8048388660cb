"""Section `cases`: excitation amplitudes, and how the motion of each case is integrated."""

from typing import Annotated

from pydantic import Field

from vibroimpact_pipeline.config.cost import above
from vibroimpact_pipeline.config.fields import Force, Name, State, beyond_walls, unit
from vibroimpact_pipeline.config.section import Section

SAMPLES = 200_000
"""Rows of a table of samples: a picture shows no more, and its files grow with each."""
DIGIT_CYCLES = 5_000_000
"""Decimal digits times forcing cycles of a motion in arbitrary precision: hours."""


class Simulation(Section):
    """The direct integration of a case: a transient that is left out, and the window that is kept."""

    initial_state: State
    transient_cycles: Annotated[int, Field(ge=0, le=1_000_000)] = Field(
        description="Cycles before the window", json_schema_extra=unit("forcing periods")
    )
    window_cycles: Annotated[int, Field(ge=1, le=10_000)] = Field(
        description=f"Cycles that are kept; with all their samples at most {SAMPLES} rows",
        json_schema_extra=unit("forcing periods"),
    )
    samples_per_cycle: Annotated[int, Field(ge=8, le=10_000, multiple_of=2)] = Field(
        description="Samples in a cycle, an even number: half a period later is a sample, too"
    )
    digits: Annotated[int, Field(ge=20, le=2000)] = Field(
        default=None,
        description="Where it stands, the motion is carried with so many decimal digits, and proved by twice as many; "
        f"digits times cycles are at most {DIGIT_CYCLES}",
        json_schema_extra=unit("decimal digits"),
    )

    def conditions(self):
        yield from beyond_walls(self.initial_state)
        window = {"window_cycles": self.window_cycles, "samples_per_cycle": self.samples_per_cycle}
        yield from above(("window_cycles",), SAMPLES, "samples", **window)
        cycles = {"cycles (transient_cycles + window_cycles)": self.transient_cycles + self.window_cycles}
        if self.digits is not None:
            yield from above(("digits",), DIGIT_CYCLES, "digit-cycles", digits=self.digits, **cycles)


class Case(Section):
    """A pair of forces, and the direct integration under them."""

    f10_hat: Force = Field(description="Excitation amplitude of box 1, in anti-phase if negative")
    f20_hat: Force = Field(description="Excitation amplitude of box 2")
    simulation: Simulation


Cases = Annotated[
    dict[Name, Case],
    Field(min_length=1, max_length=12, description="Excitation amplitudes, and how the motion is integrated"),
]
"""At most twelve: companions have a panel for each."""
