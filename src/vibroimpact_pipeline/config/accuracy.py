"""Section `accuracy`: the motions that methods are measured on, and how long a timing is repeated."""

from typing import Literal

from pydantic import Field

from vibroimpact_pipeline.config.fields import TITLE, Motion, named
from vibroimpact_pipeline.config.section import Section


class Problem(Motion):
    """A test problem of the work-precision chart; every method and the reference run it many times."""

    cycles: int = Field(ge=1, le=100, description="Length [forcing periods]")


class Benchmark(Motion):
    """The motion of `make benchmark`."""

    cycles: int = Field(ge=1, le=1000, description="Length [forcing periods]")


class Accuracy(Section):
    """What the methods are measured on."""

    effort: Literal["quick", "full"] = Field("quick", description="full: longer timings, all stress tests [minutes]")
    short_seconds: float = Field(ge=1e-3, le=1, description="Repeat a timing for so long, in the default build [s]")
    full_seconds: float = Field(ge=1e-3, le=60, description="The same in the full form [s]")
    problems: named(Problem, 1, 3, TITLE) = Field(description="Test problems by free titles")
    benchmark: Benchmark
