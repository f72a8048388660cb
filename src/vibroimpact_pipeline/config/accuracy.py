"""Section `accuracy`: the motions that methods are measured on, and how long a timing is repeated."""

from typing import Annotated

from pydantic import Field

from vibroimpact_pipeline.config.fields import Motion, Title, unit
from vibroimpact_pipeline.config.section import Section


class Problem(Motion):
    """A test problem of the work-precision chart."""

    cycles: Annotated[int, Field(ge=1, le=100)] = Field(
        description="Length; every method and the reference in arbitrary precision run it many times",
        json_schema_extra=unit("forcing periods"),
    )


class Benchmark(Motion):
    """The motion of `make benchmark`."""

    cycles: Annotated[int, Field(ge=1, le=1000)] = Field(
        description="Length", json_schema_extra=unit("forcing periods")
    )


class Accuracy(Section):
    """What the methods are measured on."""

    short_seconds: Annotated[float, Field(ge=1e-3, le=1)] = Field(
        description="The timing of a setting is repeated for so long, in the default build", json_schema_extra=unit("s")
    )
    full_seconds: Annotated[float, Field(ge=1e-3, le=60)] = Field(
        description="The same in the full form", json_schema_extra=unit("s")
    )
    problems: Annotated[dict[Title, Problem], Field(min_length=1, max_length=3)]
    benchmark: Benchmark
