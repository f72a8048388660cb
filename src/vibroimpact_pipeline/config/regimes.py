"""Section `regimes`: regimes of the exact system other than 1:1 responses, and the resolution of their search."""

from dataclasses import fields
from typing import Annotated, ClassVar, Literal

from pydantic import Field

from vibroimpact.system import System
from vibroimpact_pipeline.config import kinds
from vibroimpact_pipeline.config.section import Section

CYCLES, HELD = 20_000_000_000, 4_000_000
"""Forcing cycles of one job, half a million in a second: a night in all; and those whose events are held in memory."""
NEAR = "How near to repeating before Newton's method takes over; half a cavity is 1"

WatchedCycles = Annotated[int, Field(ge=1, le=100_000)]
Values = Annotated[int, Field(ge=2, le=1000)]
NAMES = tuple(field.name for field in fields(System))
Along = kinds.items(Literal[NAMES], 1, len(NAMES), "The parameters that move together")
ODD = kinds.needs(lambda numbers: numbers == sorted({n for n in numbers if n % 2}), "are not odd and ascending")
Harmonic = Annotated[int, Field(ge=1, le=999)]
Velocity = Annotated[float, Field(gt=0, le=1e4)]
DEAR = f"with `observation` takes more than {CYCLES:.0e} forcing cycles in a job, or {HELD:.0e} in memory"


def affordable(observation, starts: int, times: int = 1, more: int = 0) -> bool:
    """Return True if the cycles of all starts and values are within the limit of one job."""
    longest = observation.longest() + more
    return starts * observation.cycles <= HELD and times * starts * longest <= CYCLES


class Exponent(Section):
    """Length of the measurement of a Lyapunov exponent."""

    blocks: int = Field(ge=2, le=10_000, description="Blocks of a Lyapunov exponent; their spread is its error")
    block: int = Field(ge=1, le=10_000, description="Cycles of a block [forcing periods]")


class Observation(Exponent):
    """Length of the observation of one start."""

    cycles: kinds.Cycles = Field(
        description="A start is simulated for so long before it is looked at [forcing periods]"
    )
    rounds: int = Field(ge=1, le=1000, description="At most so many times, until it repeats")
    window: int = Field(ge=4, le=10_000, description="Cycles that it is looked at [forcing periods]")
    nearness: float = Field(ge=1e-6, le=0.5, description=NEAR)
    retest: kinds.Cycles = Field(
        description="The name of a motion without repetition is tried so long [forcing periods]"
    )

    def longest(self) -> int:
        """Return the largest number of cycles for one start."""
        exponent = self.blocks * self.block
        return self.cycles * self.rounds + self.window + 2 * (self.retest + self.window + exponent)


class Line(Section):
    """Parameters that move together."""

    along: Along

    def moves(self):
        return [dict.fromkeys(self.along, value) for value in getattr(self, "range", None) or self.values]


class BranchPath(Line):
    """A line through the parameters."""

    range: kinds.span(kinds.Number)


class Attractors(kinds.Starts):
    """Attractors found from random starts along the paths of the branches."""

    values: Values = Field(description="Values along each path")


class Branches(Section):
    """Branches of 1:1 responses along paths through the parameters."""

    case: kinds.CaseName
    paths: kinds.items(BranchPath, 1, 4, "Lines through the parameters")
    longest_step: float = Field(gt=0, le=1000, description="Longest step of a branch, 200 of every path at most")
    seeds: int = Field(ge=1, le=100, description="Values of a path at which branches are looked for")
    attractors: Attractors

    # A continuation gives up after 2000 points, and a branch is longer than its range.
    rules: ClassVar = [
        ("longest_step", "longest_step >= max(path.range[1] - path.range[0] for path in paths) / 200"),
        ("paths", "len({tuple(path.along) for path in paths}) == len(paths)"),
    ]


class Modulation(Exponent, kinds.Starts):
    """Modulated responses in numbers."""

    cycles: WatchedCycles = Field(description="Window of the measures [forcing periods]")
    windows: kinds.items(WatchedCycles, 1, 20, "Windows that measures are compared over [forcing periods]")


class Basins(Section):
    """Basins of attraction on a plane of starts."""

    case: kinds.CaseName
    points: int = Field(ge=2, le=1000, description="Starts along each axis")


class Mixed(Section):
    """A fixed point next to the fold of the manifold, left out: time scales cannot be told apart there."""

    case: kinds.CaseName
    label: kinds.Label


class EpsilonRange(Section):
    """Values of epsilon at which theory and exact responses are compared."""

    epsilon: kinds.items(kinds.Epsilon, 2, 2, "First and last value")
    values: int = Field(ge=3, le=1000, description="Values, evenly on a logarithmic scale")
    fit_below: float = Field(gt=0, le=10, description="Fit orders to the values below this, two at least")

    # The second lowest value.
    rules: ClassVar = [("fit_below", "min(epsilon) * (max(epsilon) / min(epsilon)) ** (1 / (values - 1)) < fit_below")]

    def moves(self):
        return [{"epsilon": value} for value in self.epsilon]


class Asymmetric(EpsilonRange):
    """Asymmetric pairs towards small epsilon, over the manifold."""

    C_max: float = Field(ge=kinds.HIGHEST, le=100, description="Right end of the manifold, beyond the derived limits")


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
    values: Values = Field(description="Values, evenly on a logarithmic scale")
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

    def conditions(self):
        watched, paths, tried, seen = self.observation, self.branches.paths, self.branches.attractors, self.modulation
        if not affordable(watched, tried.starts, times=len(paths) * tried.values):
            yield ("branches", "attractors"), DEAR
        if not affordable(watched, seen.starts + 1, more=2 * seen.cycles + seen.blocks * seen.block):
            yield ("modulation", "starts"), f"{seen.starts} {DEAR}"
        if not affordable(watched, self.basins.points**2):
            yield ("basins", "points"), f"{self.basins.points}^2 {DEAR}"
