"""Section `stability`: axes of the companions of figures 10.4 and 10.5, and the grid that criteria are judged on."""

from typing import Annotated

from pydantic import Field, Strict

from vibroimpact_pipeline.config.cost import above
from vibroimpact_pipeline.config.fields import Epsilon, ForceRange, Points, not_ascending, over_forces, repeated
from vibroimpact_pipeline.config.section import Change, Section

ORBITS = 1_000_000
"""Searches for all symmetric orbits, some ten milliseconds each."""

BeyondLimits = Annotated[float, Field(ge=1.69, le=100)]
"""Beyond the highest of the derived limits, pi^2 / (pi^2 - 4) = 1.68."""


class Companion1004(Section):
    """Companion of figure 10.4."""

    C_max: BeyondLimits = Field(description="Right end of the axis, beyond the derived limits (up to 1.68)")


class Companion1005(Section):
    """Companion of figure 10.5."""

    C_range: Annotated[
        tuple[Annotated[float, Field(ge=0, le=0.6)], BeyondLimits],
        Strict(False),  # a list will do
        Field(description="Lower and upper end of the axis, which holds the derived limits (up to 1.68)"),
    ]


class VerdictGrid(Section):
    """The theory's verdicts against exact orbits, at the centres of points x points cells of forces."""

    f10_range: ForceRange
    f20_range: ForceRange
    points: Points = Field(description=f"Cells along each axis; with all epsilon at most {ORBITS} searches for orbits")
    epsilon: Annotated[list[Epsilon], Field(min_length=1, max_length=20)] = Field(
        description="Values at which the exact orbits are looked for"
    )

    def conditions(self):
        for name in ("f10_range", "f20_range"):
            yield from not_ascending(name, getattr(self, name))
        yield from repeated("epsilon", self.epsilon)
        factors = {"cells (points^2)": self.points**2, "values of epsilon": len(self.epsilon)}
        yield from above(("points",), ORBITS, "searches for orbits", **factors)

    def changes(self):
        yield from over_forces(self)
        yield Change(("epsilon",), None, ["epsilon"], self.epsilon)


class Stability(Section):
    """The companions of figures 10.4 and 10.5, and the grid of verdicts."""

    companion_10_04: Companion1004
    companion_10_05: Companion1005
    verdict_grid: VerdictGrid
