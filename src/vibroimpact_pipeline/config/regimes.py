"""Section `regimes`: what the exact system does beside its 1:1 responses, and how finely it is asked."""

from typing import Annotated, Literal

from pydantic import Field

from vibroimpact_pipeline.config.fields import CaseName, Epsilon, ForceGrid, Forces, Label, Number, Starts, items, span
from vibroimpact_pipeline.config.section import Section, above
from vibroimpact_pipeline.config.system import NAMES

CYCLES, HELD = 2e10, 4_000_000
"""Forcing cycles of one job, half a million in a second: a night in all; and those whose events are held in memory."""
FINEST = 200
"""Steps of a continuation over its range: it gives up after 2000 points, and a branch is longer than its range."""
FIT = 2
"""Values of epsilon that an order needs."""
NEAR = "How near to repeating before Newton's method takes over; half a cavity is 1"

Cycles = Annotated[int, Field(ge=1, le=1_000_000)]
WatchedCycles = Annotated[int, Field(ge=1, le=100_000)]
Values = Annotated[int, Field(ge=2, le=1000)]


def costs(place, starts: int, once: int, cycles: int, /, **factors: float):
    """Yield what is too much in a job that settles starts.

    starts, once: held in memory together, each so many cycles long. cycles: of a start in all. factors: how many there
    are in the job.
    """
    held = {"starts at once": starts, "cycles (observation)": once}
    yield from above(place, HELD, "forcing cycles in memory", **held)
    yield from above(place, CYCLES, "forcing cycles of a job", **factors, **{"cycles of a start (observation)": cycles})


class Exponent(Section):
    """How long a Lyapunov exponent is measured."""

    blocks: int = Field(ge=2, le=10_000, description="Blocks of a Lyapunov exponent; their spread is its error")
    block: int = Field(ge=1, le=10_000, description="Cycles of a block [forcing periods]")


class Observation(Exponent):
    """How long a start is looked at."""

    cycles: Cycles = Field(description="Cycles that a start is simulated before it is looked at [forcing periods]")
    rounds: int = Field(ge=1, le=1000, description="At most so many times, until it repeats")
    window: int = Field(ge=4, le=10_000, description="Cycles that it is looked at [forcing periods]")
    nearness: float = Field(ge=1e-6, le=0.5, description=NEAR)
    retest: Cycles = Field(description="Cycles that the name of a motion without repetition is tried [forcing periods]")

    def longest(self) -> int:
        """Return most cycles that one start may take."""
        exponent = self.blocks * self.block
        return self.cycles * self.rounds + self.window + 2 * (self.retest + self.window + exponent)


class Line(Section):
    """Parameters that move together."""

    along: items(Literal[NAMES], 1, len(NAMES), "The parameters that move together")

    def moves(self):
        return [dict.fromkeys(self.along, value) for value in getattr(self, "range", None) or self.values]


class BranchPath(Line):
    """A line through the parameters."""

    range: span(Number)


class Attractors(Starts):
    """What starts end in along the paths of the branches."""

    values: Values = Field(description="Values along each path")


class Branches(Section):
    """Branches of 1:1 responses along paths through the parameters."""

    case: CaseName
    paths: items(BranchPath, 1, 4, "Lines through the parameters")
    longest_step: float = Field(gt=0, le=1000, description=f"Longest step of a branch, {FINEST} of every path at most")
    seeds: int = Field(ge=1, le=100, description="Values of a path at which branches are looked for")
    attractors: Attractors

    def conditions(self):
        finest = max(path.range[1] - path.range[0] for path in self.paths) / FINEST
        if self.longest_step < finest:
            yield ("longest_step",), f"{self.longest_step} is below {finest:g}, a part in {FINEST} of a path"
        if len({tuple(path.along) for path in self.paths}) < len(self.paths):
            yield ("paths",), "two of them are along the same parameters"


class Lifetimes(Line, Starts):
    """The mean life of the chaos."""

    values: items(Number, 1, 1000, "What they are set to")
    step: WatchedCycles = Field(description="Starts are looked at every so many cycles [forcing periods]")
    longest: Cycles = Field(description="A start is given up after so many, two steps at least [forcing periods]")

    def conditions(self):
        if self.longest < 2 * self.step:
            yield ("longest",), f"{self.longest} is below {2 * self.step}, twice `step`"
        factors = {"values": len(self.values), "starts": self.starts, "longest": self.longest}
        yield from above(("longest",), CYCLES, "forcing cycles", **factors)
        yield from above(("step",), HELD, "forcing cycles in memory", starts=self.starts, step=self.step)


class TorusPath(Line):
    """Values on both sides of a Neimark-Sacker point."""

    values: items(Number, 2, 1000, "What they are set to")


class Tori(Section):
    """The size of the tori next to Neimark-Sacker points."""

    paths: items(TorusPath, 1, 10, "Values on both sides of Neimark-Sacker points")
    cycles: int = Field(ge=2, le=1_000_000, description="Cycles that a torus is seen for [forcing periods]")
    discarded: Cycles = Field(description="Cycles before those [forcing periods]")

    def conditions(self):
        factors = {"paths": len(self.paths), "values": max(len(path.values) for path in self.paths), "sweeps": 2}
        cycles = {"cycles (discarded + cycles)": self.discarded + self.cycles}
        return above(("discarded",), CYCLES, "forcing cycles", **factors, **cycles)


class Coexistence(Section):
    """Where chaos and periodic motions coexist."""

    case: CaseName
    lifetimes: Lifetimes
    tori: Tori


class Modulation(Exponent, Starts):
    """Modulated responses in numbers."""

    cycles: WatchedCycles = Field(description="Window of the measures [forcing periods]")
    windows: items(WatchedCycles, 1, 20, "Windows that measures are compared over [forcing periods]")


class Basins(Section):
    """In which response a start ends, on a plane of starts."""

    case: CaseName
    points: int = Field(ge=2, le=1000, description="Starts along each axis")


class Mixed(Section):
    """A fixed point next to the fold of the manifold, to which no order is fitted."""

    case: CaseName
    label: Label


class EpsilonRange(Section):
    """Values of epsilon at which theory and exact responses are compared."""

    epsilon: items(Epsilon, 2, 2, "First and last value")
    values: int = Field(ge=3, le=1000, description="Values, evenly on a logarithmic scale")
    fit_below: float = Field(gt=0, le=10, description=f"Fit orders to the values below this, {FIT} at least")

    def conditions(self):
        low, high = sorted(self.epsilon)
        ratio = (high / low) ** (1 / (self.values - 1))
        if (fitted := sum(low * ratio**k < self.fit_below for k in range(self.values))) < FIT:
            yield ("fit_below",), f"below {self.fit_below} are {fitted} values of epsilon; a fit takes {FIT}"

    def moves(self):
        return [{"epsilon": value} for value in self.epsilon]


class EpsilonLimit(EpsilonRange):
    """Theory against exact responses as epsilon tends to 0."""

    mixed: Mixed | None = None


class Ladder(ForceGrid):
    """The levels between leading order and the exact orbit."""

    harmonics: items(Annotated[int, Field(ge=1, le=999)], 3, 20, "Highest harmonics of levels: odd, ascending", list)
    fold_range: Forces = Field(description="Range of f20_hat, the rest as in the first case, with one fold")

    def conditions(self):
        if self.harmonics != sorted(set(self.harmonics)) or any(value % 2 == 0 for value in self.harmonics):
            yield ("harmonics",), f"{self.harmonics} are not odd and ascending"


class Decay(Section):
    """How long an impulse is felt."""

    case: CaseName
    impulses: span(Annotated[float, Field(gt=0, le=1e4)], "First and last velocity that a box is given [L omega_10]")
    values: Values = Field(description="Values, evenly on a logarithmic scale")
    fraction: float = Field(ge=1e-6, lt=1, description="The part of the energy that is left then")


class Regimes(Section):
    """What the exact system does beside its 1:1 responses."""

    observation: Observation
    branches: Branches
    coexistence: Coexistence
    modulation: Modulation
    basins: Basins
    epsilon: EpsilonLimit
    asymmetric: EpsilonRange
    ladder: Ladder
    decay: Decay

    def conditions(self):
        once, longest = self.observation.cycles, self.observation.longest()
        tried, paths = self.branches.attractors, {"paths": len(self.branches.paths)}
        factors = paths | {"values": tried.values, "starts": tried.starts}
        yield from costs(("branches", "attractors"), tried.starts, once, longest, **factors)
        tried, starts = self.modulation, self.modulation.starts + 1
        measured = longest + 2 * tried.cycles + tried.blocks * tried.block
        yield from costs(("modulation", "starts"), starts, once, measured, starts=starts)
        starts = {"starts (points^2)": self.basins.points**2}
        yield from costs(("basins", "points"), *starts.values(), once, longest, **starts)
