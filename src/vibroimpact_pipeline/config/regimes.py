"""Section `regimes`: what the exact system does beside its 1:1 responses, and how finely it is asked."""

from collections.abc import Iterator
from typing import Annotated, Literal

import numpy as np
from pydantic import Field

from vibroimpact_pipeline.config.cost import CYCLES, HELD, above
from vibroimpact_pipeline.config.fields import (
    CaseName,
    Epsilon,
    ForceRange,
    Label,
    Number,
    Points,
    Seed,
    Starts,
    not_ascending,
    over_forces,
    repeated,
    unit,
)
from vibroimpact_pipeline.config.section import Change, Place, Problem, Section
from vibroimpact_pipeline.config.system import NAMES

FINEST = 200
"""Steps of a continuation over its range: it gives up after 2000 points, and a branch is longer than its range."""
FIT = 2
"""Values of epsilon that an order needs."""

Cycles = Annotated[int, Field(ge=1, le=1_000_000, json_schema_extra=unit("forcing periods"))]
WatchedCycles = Annotated[int, Field(ge=1, le=100_000, json_schema_extra=unit("forcing periods"))]
Count = Annotated[int, Field(ge=1, le=10_000)]
Blocks = Annotated[int, Field(ge=2, le=10_000, description="Blocks of a Lyapunov exponent; their spread is its error")]
Along = Annotated[list[Literal[NAMES]], Field(min_length=1, max_length=len(NAMES))]
Values = Annotated[int, Field(ge=2, le=1000)]


def costs(place: Place, starts: int, once: int, cycles: int, /, **factors: float) -> Iterator[Problem]:
    """What is too much in a job that settles starts.

    starts, once: held in memory together, each so many cycles long. cycles: of a start in all. factors: how many there
    are in the job.
    """
    held = {"starts at once": starts, "cycles (observation)": once}
    yield from above(place, HELD, "forcing cycles in memory", **held)
    yield from above(place, CYCLES, "forcing cycles of a job", **factors, **{"cycles of a start (observation)": cycles})


class Observation(Section):
    """How long a start is looked at."""

    cycles: Cycles = Field(description="A start is simulated for so many cycles before it is looked at")
    rounds: Annotated[int, Field(ge=1, le=1000)] = Field(description="At most so many times, until it repeats")
    window: Annotated[int, Field(ge=4, le=10_000)] = Field(
        description="Cycles that it is looked at", json_schema_extra=unit("forcing periods")
    )
    nearness: Annotated[float, Field(ge=1e-6, le=0.5)] = Field(
        description="How near a start comes to repeating before Newton's method takes over; half a cavity is 1"
    )
    blocks: Blocks
    block: Count = Field(description="Cycles of a block", json_schema_extra=unit("forcing periods"))
    retest: Cycles = Field(description="Cycles over which the name of a motion that does not repeat is tried")

    def longest(self) -> int:
        """Most cycles that one start may take."""
        exponent = self.blocks * self.block
        return self.cycles * self.rounds + self.window + 2 * (self.retest + self.window + exponent)

    def conditions(self):
        yield from above(("cycles",), CYCLES, "forcing cycles of a start", cycles=self.cycles, rounds=self.rounds)


class Line(Section):
    """Parameters that move together."""

    along: Along = Field(description="The parameters that move together")

    def conditions(self):
        yield from repeated("along", self.along)


class BranchPath(Line):
    """A line through the parameters."""

    range: Annotated[list[Number], Field(min_length=2, max_length=2)] = Field(description="Where they begin and end")

    def conditions(self):
        yield from super().conditions()
        yield from not_ascending("range", self.range)


class Attractors(Section):
    """What starts end in along the paths of the branches."""

    values: Values = Field(description="Values along each path")
    starts: Starts
    seed: Seed

    def costs(self, once, cycles, paths):
        factors = {"paths": paths, "values": self.values, "starts": self.starts}
        return costs(("branches", "attractors"), self.starts, once, cycles, **factors)


class Branches(Section):
    """Branches of 1:1 responses along paths through the parameters."""

    case: CaseName
    paths: Annotated[list[BranchPath], Field(min_length=1, max_length=4)]
    longest_step: Annotated[float, Field(gt=0, le=1000)] = Field(
        description=f"Longest step along a branch, at least a part in {FINEST} of every path"
    )
    seeds: Annotated[int, Field(ge=1, le=100)] = Field(description="Values of a path at which branches are looked for")
    attractors: Attractors

    def conditions(self):
        finest = max(path.range[1] - path.range[0] for path in self.paths) / FINEST
        if self.longest_step < finest:
            yield Problem(("longest_step",), f"{self.longest_step} is below {finest:g}, a part in {FINEST} of a path")
        yield from repeated("paths", [" ".join(path.along) for path in self.paths])

    def changes(self):
        for number, path in enumerate(self.paths):
            yield Change(("paths", number, "range"), self.case, path.along, path.range)


class Lifetimes(Line):
    """The mean life of the chaos."""

    values: Annotated[list[Number], Field(min_length=1, max_length=1000)] = Field(description="What they are set to")
    starts: Starts
    seed: Seed
    step: WatchedCycles = Field(description="Starts are looked at every so many cycles")
    longest: Cycles = Field(description="A start is given up after so many, two steps at least: one is not counted")

    def conditions(self):
        yield from super().conditions()
        yield from repeated("values", self.values)
        if self.longest < 2 * self.step:
            yield Problem(("longest",), f"{self.longest} is below {2 * self.step}, twice `step`")
        factors = {"values": len(self.values), "starts": self.starts, "longest": self.longest}
        yield from above(("longest",), CYCLES, "forcing cycles", **factors)
        yield from above(("step",), HELD, "forcing cycles in memory", starts=self.starts, step=self.step)


class TorusPath(Line):
    """Values on both sides of a Neimark-Sacker point."""

    values: Annotated[list[Number], Field(min_length=2, max_length=1000)] = Field(description="What they are set to")

    def conditions(self):
        yield from super().conditions()
        yield from repeated("values", self.values)


class Tori(Section):
    """The size of the tori next to Neimark-Sacker points."""

    paths: Annotated[list[TorusPath], Field(min_length=1, max_length=10)]
    cycles: Annotated[int, Field(ge=2, le=1_000_000)] = Field(
        description="Cycles that a torus is seen for", json_schema_extra=unit("forcing periods")
    )
    discarded: Cycles = Field(description="Cycles before those")

    def conditions(self):
        values = max(len(path.values) for path in self.paths)
        cycles = {"cycles (discarded + cycles)": self.discarded + self.cycles}
        factors = {"paths": len(self.paths), "values": values, "sweeps": 2, **cycles}
        yield from above(("discarded",), CYCLES, "forcing cycles", **factors)


class Coexistence(Section):
    """Where chaos and periodic motions coexist."""

    case: CaseName
    lifetimes: Lifetimes
    tori: Tori

    def changes(self):
        yield Change(("lifetimes", "values"), self.case, self.lifetimes.along, self.lifetimes.values)
        for number, path in enumerate(self.tori.paths):
            yield Change(("tori", "paths", number, "values"), self.case, path.along, path.values)


class Confusion(Section):
    """Every name of a regime against a longer run, over a grid of forces."""

    f10_range: ForceRange
    f20_range: ForceRange
    points: Points
    starts: Starts
    seed: Seed
    times: Annotated[int, Field(ge=1, le=10_000)] = Field(description="So many times as long as all rounds")

    def conditions(self):
        for name in ("f10_range", "f20_range"):
            yield from not_ascending(name, getattr(self, name))

    def changes(self):
        return over_forces(self)

    def costs(self, rounds, cycles):
        longer = self.times * rounds
        factors = {"cells (points^2)": self.points**2, "starts": self.starts}
        return costs(("confusion", "points"), self.starts, longer, cycles + longer, **factors)


class Modulation(Section):
    """Modulated responses in numbers."""

    starts: Starts
    seed: Seed
    cycles: WatchedCycles = Field(description="Window of the measures")
    blocks: Blocks
    block: Count = Field(description="Cycles of a block", json_schema_extra=unit("forcing periods"))
    windows: Annotated[list[WatchedCycles], Field(min_length=1, max_length=20)] = Field(
        description="Windows over which measures of the envelope are compared"
    )

    def conditions(self):
        yield from repeated("windows", self.windows)

    def costs(self, once, cycles):
        own = 2 * self.cycles + self.blocks * self.block
        return costs(("modulation", "starts"), self.starts + 1, once, cycles + own, starts=self.starts + 1)


class Basins(Section):
    """In which response a start ends, on a plane of starts."""

    case: CaseName
    points: Annotated[int, Field(ge=2, le=1000)] = Field(description="Starts along each axis")

    def costs(self, once, cycles):
        return costs(("basins", "points"), self.points**2, once, cycles, **{"starts (points^2)": self.points**2})


class Mixed(Section):
    """A fixed point next to the fold of the manifold, to which no order is fitted."""

    case: CaseName
    label: Label


class EpsilonRange(Section):
    """Values of epsilon at which theory and exact responses are compared."""

    epsilon: Annotated[list[Epsilon], Field(min_length=2, max_length=2)] = Field(description="First and last value")
    values: Annotated[int, Field(ge=3, le=1000)] = Field(description="Values, evenly on a logarithmic scale")
    fit_below: Annotated[float, Field(gt=0, le=10)] = Field(
        description="Orders are fitted to the values of epsilon below this, which takes two of them at least"
    )

    def conditions(self):
        yield from repeated("epsilon", self.epsilon)
        fitted = int(np.sum(np.geomspace(*self.epsilon, self.values) < self.fit_below))
        if fitted < FIT:
            yield Problem(("fit_below",), f"below {self.fit_below} are {fitted} values of epsilon; a fit takes {FIT}")

    def changes(self):
        yield Change(("epsilon",), None, ["epsilon"], self.epsilon)


class EpsilonLimit(EpsilonRange):
    """Theory against exact responses as epsilon tends to 0."""

    mixed: Mixed = None


class Ladder(Section):
    """The rungs between leading order and the exact orbit."""

    harmonics: Annotated[list[Annotated[int, Field(ge=1, le=999)]], Field(min_length=3, max_length=20)] = Field(
        description="Highest harmonics of the rungs: odd, ascending"
    )
    f10_range: ForceRange
    f20_range: ForceRange
    points: Points
    fold_range: ForceRange = Field(description="Range of f20_hat, the rest as in the first case, with one fold")

    def conditions(self):
        for name in ("f10_range", "f20_range", "fold_range"):
            yield from not_ascending(name, getattr(self, name))
        for place, value in enumerate(self.harmonics):
            if value % 2 == 0:
                yield Problem(("harmonics", place), f"{value} is even; symmetric motions have odd harmonics only")
        if self.harmonics != sorted(set(self.harmonics)):
            yield Problem(("harmonics",), f"{self.harmonics} do not ascend")

    def changes(self):
        return [*over_forces(self), Change(("fold_range",), None, ["f20_hat"], self.fold_range)]


class Decay(Section):
    """How long an impulse is felt."""

    case: CaseName
    impulses: Annotated[list[Annotated[float, Field(gt=0, le=1e4)]], Field(min_length=2, max_length=2)] = Field(
        description="First and last velocity that is given to a box", json_schema_extra=unit("L omega_10")
    )
    values: Values = Field(description="Values, evenly on a logarithmic scale")
    fraction: Annotated[float, Field(ge=1e-6, lt=1)] = Field(description="The part of the energy that is left then")

    def conditions(self):
        yield from not_ascending("impulses", self.impulses)


class Regimes(Section):
    """What the exact system does beside its 1:1 responses."""

    observation: Observation
    branches: Branches
    coexistence: Coexistence
    confusion: Confusion
    modulation: Modulation
    basins: Basins
    epsilon: EpsilonLimit
    asymmetric: EpsilonRange
    ladder: Ladder
    decay: Decay

    def conditions(self):
        once, longest = self.observation.cycles, self.observation.longest()
        yield from self.branches.attractors.costs(once, longest, len(self.branches.paths))
        yield from self.confusion.costs(once * self.observation.rounds, longest)
        yield from self.modulation.costs(once, longest)
        yield from self.basins.costs(once, longest)
