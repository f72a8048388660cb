"""Section `regimes`: regimes of the exact system other than 1:1 responses, and the resolution of their search."""

import dataclasses
from typing import Annotated, Literal

from pydantic import Field

from vibroimpact.system import System
from vibroimpact_pipeline.config import fields
from vibroimpact_pipeline.config.section import Section

NEAR = "How near to repeating before Newton's method takes over; half a cavity is 1"
NAMES = tuple(field.name for field in dataclasses.fields(System))
Along = fields.items(Literal[NAMES], 1, len(NAMES), "The parameters that move together")
APART = fields.needs(lambda paths: len({tuple(path.along) for path in paths}) == len(paths), "should differ in `along`")
Window = Annotated[int, Field(ge=1, le=100_000)]


class Exponent(Section):
    """Length of the measurement of a Lyapunov exponent."""

    blocks: fields.count("Blocks of a Lyapunov exponent; their spread is its error", 2, 10_000)
    block: fields.count("Cycles of a block [forcing periods]", 1, 10_000)


class Observation(Exponent):
    """Length of the observation of one start."""

    cycles: fields.count("A start is simulated for so long before it is looked at; see docs/howto.md [forcing periods]")
    rounds: fields.count("At most so many times, until it repeats", 1, 1000)
    window: fields.count("Cycles that it is looked at [forcing periods]", 4, 10_000)
    nearness: fields.real(NEAR, 1e-6, 0.5)
    retest: fields.count("The name of a motion without repetition is tried so long [forcing periods]")


class BranchPath(Section):
    """A line through the parameters, along which they move together."""

    along: Along
    range: fields.span(fields.Number)


class Attractors(Section):
    """Attractors found from random starts along the paths of the branches."""

    values: fields.count("Values along each path", 2, fields.MOST)
    starts: fields.Starts
    seed: fields.Seed


class Branches(Section):
    """Branches of 1:1 responses along paths through the parameters."""

    case: fields.CaseName
    paths: fields.items(BranchPath, 1, 4, "Lines through the parameters", APART)
    longest_step: fields.real("Longest step of a branch, 200 of every path at most", 1e-6, 1000)
    seeds: fields.count("Values of a path at which branches are looked for", 1, 100)
    attractors: Attractors

    def conditions(self):
        # A continuation gives up after 2000 points, and a branch is longer than its range.
        if self.longest_step < (least := max(path.range[1] - path.range[0] for path in self.paths) / 200):
            yield ("longest_step",), f"{self.longest_step} should be at least {least:g}, 1/200 of the longest path"


class Modulation(Exponent):
    """Modulated responses in numbers."""

    starts: fields.Starts
    seed: fields.Seed
    cycles: fields.count("Window of the measures [forcing periods]", 1, 100_000)
    windows: fields.items(Window, 1, 20, "Windows that measures are compared over [forcing periods]")


class Basins(Section):
    """Basins of attraction on a plane of starts."""

    case: fields.CaseName
    points: fields.Points


class Mixed(Section):
    """A fixed point next to the fold of the manifold, left out: time scales cannot be told apart there."""

    case: fields.CaseName
    label: fields.Label


class EpsilonRange(Section):
    """Values of epsilon at which theory and exact responses are compared."""

    epsilon: fields.items(fields.Epsilon, 2, 2, "First and last value")
    values: fields.count("Values, evenly on a logarithmic scale", 3, fields.MOST)
    fit_below: float = Field(gt=0, le=10, description="Fit orders to the values below this, two at least")

    def conditions(self):
        low, high = sorted(self.epsilon)
        if self.fit_below <= (second := low * (high / low) ** (1 / (self.values - 1))):
            yield ("fit_below",), f"{self.fit_below} should be above the second lowest value, {second:g}"


class Asymmetric(EpsilonRange):
    """Asymmetric pairs towards small epsilon, over the manifold."""

    C_max: fields.real("Right end of the manifold, beyond the derived limits", fields.HIGHEST, 100)


class EpsilonLimit(EpsilonRange):
    """Theory against exact responses as epsilon tends to 0."""

    mixed: Mixed | None = None


class Regimes(Section):
    """Regimes of the exact system other than 1:1 responses."""

    observation: Observation
    branches: Branches
    modulation: Modulation
    basins: Basins
    epsilon: EpsilonLimit
    asymmetric: Asymmetric
