"""Section `regimes`: settings to find regimes of the exact system, including regimes other than 1:1 responses."""

import dataclasses
from typing import Annotated, Literal

from pydantic import Field

from vibroimpact.system import System
from vibroimpact_pipeline.config import fields
from vibroimpact_pipeline.config.section import Section

NEAR = "Change of displacements after whole periods below which Newton's method starts; the clearance is 1"
NAMES = tuple(field.name for field in dataclasses.fields(System))
Along = fields.items(Literal[NAMES], 1, len(NAMES), "Parameters that vary together, with equal values")
APART = fields.needs(
    lambda paths: len({tuple(path.along) for path in paths}) == len(paths), "should differ from each other in `along`"
)
Window = Annotated[int, Field(ge=1, le=100_000)]


class Exponent(Section):
    """Number and length of the blocks from which a Lyapunov exponent is computed."""

    blocks: fields.count("Number of blocks of a Lyapunov exponent; their spread gives its error", 2, 10_000)
    block: fields.count("Length of a block [forcing periods]", 1, 10_000)


class Observation(Exponent):
    """Settings to classify the motion from one initial state."""

    cycles: fields.count("Transient before each observation, see docs/howto.md [forcing periods]")
    rounds: fields.count("Maximum number of observations until the motion repeats", 1, 1000)
    window: fields.count("Length of an observation [forcing periods]", 4, 10_000)
    nearness: fields.real(NEAR, 1e-6, 0.5)
    retest: fields.count("Time over which the regime of a non-periodic motion is tested [forcing periods]")


class BranchPath(Section):
    """A straight path in parameter space: the parameters `along` have equal values, which vary over `range`."""

    along: Along
    range: fields.span(fields.Number)


class Attractors(Section):
    """Search for attractors along the paths of `branches`. The search starts from evenly spread initial states."""

    values: fields.count("Number of values along each path", 2, fields.MAX_VALUES)
    starts: fields.Starts
    seed: fields.Seed


class Branches(Section):
    """Branches of 1:1 responses along paths in parameter space, and attractors along these paths."""

    case: fields.CaseName
    paths: fields.items(BranchPath, 1, 4, "Paths in parameter space", APART)
    longest_step: fields.real("Longest step of the continuation, at least 1/200 of the longest path", 1e-6, 1000)
    seeds: fields.count("Number of values of a path at which branches are searched", 1, 100)
    attractors: Attractors

    def conditions(self):
        # A continuation stops after 2000 points. If the longest step is 1/200 of the path, 2000 points suffice for a
        # branch that is 10 times as long as the path.
        if self.longest_step < (least := max(path.range[1] - path.range[0] for path in self.paths) / 200):
            yield ("longest_step",), f"{self.longest_step} should be at least {least:g}, 1/200 of the longest path"


class Modulation(Exponent):
    """Settings for measuring modulated responses."""

    starts: fields.Starts
    seed: fields.Seed
    cycles: fields.count("Length of the window of the measures [forcing periods]", 1, 100_000)
    windows: fields.items(Window, 1, 20, "Lengths of the windows to compare [forcing periods]")


class Basins(Section):
    """Basins of attraction on a grid of `points` x `points` states in a plane of initial states."""

    case: fields.CaseName
    points: fields.Points


class Mixed(Section):
    """A fixed point next to the fold of the slow invariant manifold.

    Fits exclude this point, since the fast and the slow time scale do not separate near the fold.
    """

    case: fields.CaseName
    label: fields.Label


class EpsilonRange(Section):
    """Values of epsilon at which the theory is compared with exact responses."""

    epsilon: fields.items(fields.Epsilon, 2, 2, "First and last value")
    values: fields.count("Number of values, evenly spaced on a logarithmic scale", 3, fields.MAX_VALUES)


class Asymmetric(EpsilonRange):
    """Settings for following asymmetric orbits to small epsilon, and for drawing the slow invariant manifold."""

    C_max: fields.real("Right end of the manifold, above the derived limits", fields.BEYOND_LIMITS, 100)


class EpsilonLimit(EpsilonRange):
    """Comparison of the theory with exact responses as epsilon tends to 0."""

    fit_below: float = Field(
        gt=0, le=10, description="Fit orders to values of epsilon below this; at least two must be below"
    )
    mixed: Mixed | None = None

    def conditions(self):
        low, high = sorted(self.epsilon)
        if self.fit_below <= (second := low * (high / low) ** (1 / (self.values - 1))):
            yield ("fit_below",), f"{self.fit_below} should be above the second lowest value, {second:g}"


class Regimes(Section):
    """Regimes of the exact system, including regimes other than 1:1 responses."""

    observation: Observation
    branches: Branches
    modulation: Modulation
    basins: Basins
    epsilon: EpsilonLimit
    asymmetric: Asymmetric
