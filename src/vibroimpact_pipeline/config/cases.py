"""Section `cases`: excitation amplitudes, and how the motion of each case is integrated."""

from pydantic import Field

from vibroimpact_pipeline.config.fields import Force, State, named
from vibroimpact_pipeline.config.section import Section, above

SAMPLES = 200_000
"""Rows of a table of samples: a picture shows no more, and its files grow with each."""
DIGIT_CYCLES = 5_000_000
"""Decimal digits times forcing cycles of a motion in arbitrary precision: hours."""


class Simulation(Section):
    """The direct integration of a case: a transient that is left out, and a window with at most 200 000 samples."""

    initial_state: State
    transient_cycles: int = Field(ge=0, le=1_000_000, description="Cycles before the window [forcing periods]")
    window_cycles: int = Field(ge=1, le=10_000, description="Cycles that are kept [forcing periods]")
    samples_per_cycle: int = Field(ge=8, le=10_000, multiple_of=2, description="Samples in a cycle, an even number")
    digits: int | None = Field(None, ge=20, le=2000, description="Decimal digits of the motion; absent: doubles")

    def conditions(self):
        window = {"window_cycles": self.window_cycles, "samples_per_cycle": self.samples_per_cycle}
        yield from above(("window_cycles",), SAMPLES, "samples", **window)
        cycles = {"cycles (transient_cycles + window_cycles)": self.transient_cycles + self.window_cycles}
        yield from above(("digits",), DIGIT_CYCLES, "digit-cycles", digits=self.digits or 0, **cycles)


class Case(Section):
    """A pair of forces, and the direct integration under them."""

    f10_hat: Force = Field(description="Excitation amplitude of box 1, in anti-phase if negative")
    f20_hat: Force = Field(description="Excitation amplitude of box 2")
    simulation: Simulation


# At most twelve: companions have a panel for each.
Cases = named(Case, 1, 12)
