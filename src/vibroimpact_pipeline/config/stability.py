"""Section `stability`: axes of the companions of figures 10.4 and 10.5, and the grid that criteria are judged on."""

from pydantic import Field

from vibroimpact_pipeline.config.fields import Epsilon, ForceGrid, around, items
from vibroimpact_pipeline.config.section import Section, above

ORBITS = 1_000_000
"""Searches for all symmetric orbits, some ten milliseconds each."""
HIGHEST = 1.69
"""Beyond the derived limits, the highest of which is pi^2 / (pi^2 - 4) = 1.68."""


class Companion1004(Section):
    """Companion of figure 10.4."""

    C_max: float = Field(ge=HIGHEST, le=100, description="Right end of the axis, beyond the derived limits (1.68)")


class Companion1005(Section):
    """Companion of figure 10.5."""

    C_range: around(0.6, HIGHEST) = Field(description="Ends of the axis, which holds the derived limits (1.68)")


class VerdictGrid(ForceGrid):
    """The theory's verdicts against exact orbits, at the centres of points x points cells of forces."""

    epsilon: items(Epsilon, 1, 20, "Values at which the exact orbits are looked for")

    def conditions(self):
        factors = {"cells (points^2)": self.points**2, "values of epsilon": len(self.epsilon)}
        return above(("points",), ORBITS, "searches for orbits", **factors)

    def moves(self):
        return [{"epsilon": value} for value in self.epsilon]


class Stability(Section):
    """The companions of figures 10.4 and 10.5, and the grid of verdicts."""

    companion_10_04: Companion1004
    companion_10_05: Companion1005
    verdict_grid: VerdictGrid
