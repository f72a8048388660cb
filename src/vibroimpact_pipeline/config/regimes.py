"""Section `regimes`: regimes of the exact system other than 1:1 responses, and the resolution of their search."""

from dataclasses import fields
from typing import Annotated, Literal

from pydantic import Field

from vibroimpact.system import System
from vibroimpact_pipeline.config import kinds
from vibroimpact_pipeline.config.section import Section

NEAR = "How near to repeating before Newton's method takes over; half a cavity is 1"
NAMES = tuple(field.name for field in fields(System))
Along = kinds.items(Literal[NAMES], 1, len(NAMES), "The parameters that move together")
ODD = kinds.needs(lambda numbers: numbers == sorted({n for n in numbers if n % 2}), "should be odd and ascending")
APART = kinds.needs(lambda paths: len({tuple(path.along) for path in paths}) == len(paths), "should differ in `along`")
Harmonic = Annotated[int, Field(ge=1, le=999)]
Velocity = Annotated[float, Field(gt=0, le=1e4)]
Window = Annotated[int, Field(ge=1, le=100_000)]


class Exponent(Section):
    """Length of the measurement of a Lyapunov exponent."""

    blocks: kinds.count("Blocks of a Lyapunov exponent; their spread is its error", 2, 10_000)
    block: kinds.count("Cycles of a block [forcing periods]", 1, 10_000)


class Observation(Exponent):
    """Length of the observation of one start."""

    cycles: kinds.count(
        "A start is simulated for so long before it is looked at; see docs/howto_sweep.md [forcing periods]"
    )
    rounds: kinds.count("At most so many times, until it repeats", 1, 1000)
    window: kinds.count("Cycles that it is looked at [forcing periods]", 4, 10_000)
    nearness: kinds.real(NEAR, 1e-6, 0.5)
    retest: kinds.count("The name of a motion without repetition is tried so long [forcing periods]")


class BranchPath(Section):
    """A line through the parameters, along which they move together."""

    along: Along
    range: kinds.span(kinds.Number)


class Attractors(Section):
    """Attractors found from random starts along the paths of the branches."""

    values: kinds.count("Values along each path", 2, kinds.MOST)
    starts: kinds.Starts
    seed: kinds.Seed


class Branches(Section):
    """Branches of 1:1 responses along paths through the parameters."""

    case: kinds.CaseName
    paths: kinds.items(BranchPath, 1, 4, "Lines through the parameters", APART)
    longest_step: kinds.real("Longest step of a branch, 200 of every path at most", 1e-6, 1000)
    seeds: kinds.count("Values of a path at which branches are looked for", 1, 100)
    attractors: Attractors

    def conditions(self):
        # A continuation gives up after 2000 points, and a branch is longer than its range.
        if self.longest_step < (least := max(path.range[1] - path.range[0] for path in self.paths) / 200):
            yield ("longest_step",), f"{self.longest_step} should be at least {least:g}, 1/200 of the longest path"


class Modulation(Exponent):
    """Modulated responses in numbers."""

    starts: kinds.Starts
    seed: kinds.Seed
    cycles: kinds.count("Window of the measures [forcing periods]", 1, 100_000)
    windows: kinds.items(Window, 1, 20, "Windows that measures are compared over [forcing periods]")


class Basins(Section):
    """Basins of attraction on a plane of starts."""

    case: kinds.CaseName
    points: kinds.Points


class Mixed(Section):
    """A fixed point next to the fold of the manifold, left out: time scales cannot be told apart there."""

    case: kinds.CaseName
    label: kinds.Label


class EpsilonRange(Section):
    """Values of epsilon at which theory and exact responses are compared."""

    epsilon: kinds.items(kinds.Epsilon, 2, 2, "First and last value")
    values: kinds.count("Values, evenly on a logarithmic scale", 3, kinds.MOST)
    fit_below: float = Field(gt=0, le=10, description="Fit orders to the values below this, two at least")

    def conditions(self):
        low, high = sorted(self.epsilon)
        if self.fit_below <= (second := low * (high / low) ** (1 / (self.values - 1))):
            yield ("fit_below",), f"{self.fit_below} should be above the second lowest value, {second:g}"


class Asymmetric(EpsilonRange):
    """Asymmetric pairs towards small epsilon, over the manifold."""

    C_max: kinds.real("Right end of the manifold, beyond the derived limits", kinds.HIGHEST, 100)


class EpsilonLimit(EpsilonRange):
    """Theory against exact responses as epsilon tends to 0."""

    mixed: Mixed | None = None


class Ladder(kinds.ForceGrid):
    """The model hierarchy between leading order and the exact orbit."""

    harmonics: kinds.items(Harmonic, 3, 20, "Highest harmonics of levels: odd, ascending", ODD)
    fold_range: kinds.Forces = Field(description="Range of f20_hat, the rest as in the first case, with one fold")


class Decay(Section):
    """Decay after an impulse."""

    case: kinds.CaseName
    impulses: kinds.span(Velocity, "First and last velocity that a box is given [L omega_10]")
    values: kinds.count("Values, evenly on a logarithmic scale", 2, kinds.MOST)
    fraction: float = Field(ge=1e-6, lt=1, description="The part of the energy that is left then")


class Regimes(Section):
    """Regimes of the exact system other than 1:1 responses."""

    observation: Observation
    branches: Branches
    modulation: Modulation
    basins: Basins
    epsilon: EpsilonLimit
    asymmetric: Asymmetric
    ladder: Ladder
    decay: Decay
