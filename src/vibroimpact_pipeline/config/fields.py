"""Kinds of values that several sections have, with their limits."""

from dataclasses import dataclass
from typing import Annotated

from pydantic import Field, Strict

from vibroimpact_pipeline.config.section import Change, Problem, Section


@dataclass(frozen=True)
class OfCase:
    """Marks the name of a case, which has to be there."""


@dataclass(frozen=True)
class OfFixedPoint:
    """Marks the label of a fixed point, which the case beside it has to have."""


def unit(name: str) -> dict:
    """What the unit of a field is called in config/README.md."""
    return {"unit": name}


NAME, LETTER, TITLE = "^[a-z][a-z0-9_]{1,39}$", "^[a-z]$", "^[A-Za-z][A-Za-z0-9 ,()-]{0,39}$"
WORDS = {
    NAME: "a name: a small letter, then 1 to 39 small letters, digits and _",
    LETTER: "one small letter",
    TITLE: "a title: a letter, then up to 39 letters, digits, spaces and , ( ) -",
}
"""What texts have to look like."""

Name = Annotated[str, Field(pattern=NAME)]
CaseName = Annotated[str, OfCase(), Field(description="Name of a case")]
Title = Annotated[str, Field(pattern=TITLE)]
Label = Annotated[
    str, OfFixedPoint(), Field(pattern=LETTER, description="Label of a fixed point of the case, from a on")
]

Force = Annotated[float, Field(ge=-1000, le=1000)]
ForceRange = Annotated[list[Force], Field(min_length=2, max_length=2, description="Lower and upper end of the forces")]
Number = Annotated[float, Field(ge=-1e6, le=1e6)]
Epsilon = Annotated[float, Field(ge=1e-6, le=10)]
Amplitude = Annotated[float, Field(gt=1, le=100)]
Planes = Annotated[
    list[Amplitude],
    Field(
        min_length=2,
        max_length=2,
        description="Right ends of the planes (C_1, B_1) and (C_2, B_2); the fold of the manifold lies below 1",
    ),
]
CRange = Annotated[
    tuple[Annotated[float, Field(ge=0, le=0.6)], Annotated[float, Field(ge=1.01, le=100)]],
    Strict(False),  # a list will do
    Field(description="Lower and upper end of the axis, which holds the limit of (10.26)"),
]
Points = Annotated[int, Field(ge=2, le=1000, description="So many cells, or starts, along each axis")]
Starts = Annotated[int, Field(ge=1, le=10_000, description="Starts, spread evenly; the first is rest")]
Seed = Annotated[int, Field(ge=0, le=2**32 - 1, description="Scrambles the starts")]
Displacement = Annotated[float, Field(ge=-1000, le=1000)]
State = Annotated[
    list[Displacement],
    Field(
        min_length=8,
        max_length=8,
        description="Start [X1, Y1, X2, Y2, X1', Y1', X2', Y2']; the balls between their walls",
    ),
]


class Motion(Section):
    """A motion from its start."""

    case: CaseName
    initial_state: State

    def conditions(self):
        yield from beyond_walls(self.initial_state)


def beyond_walls(state) -> list[Problem]:
    """Balls that would start outside their cavities."""
    X1, Y1, X2, Y2 = state[:4]
    return [
        Problem(
            ("initial_state",),
            f"ball {module} starts beyond a wall: X{module} - Y{module} = {W} is not between -1 and 1",
        )
        for module, W in ((1, X1 - Y1), (2, X2 - Y2))
        if abs(W) > 1
    ]


def not_ascending(name: str, ends) -> list[Problem]:
    """A range whose ends are the wrong way round, or the same."""
    low, high = ends
    return [] if low < high else [Problem((name,), f"{ends} is no range: {low} is not below {high}")]


def repeated(name: str, values) -> list[Problem]:
    """Values of a list that stand there twice."""
    return [
        Problem((name, place), f"{value} stands there twice")
        for place, value in enumerate(values)
        if value in values[:place]
    ]


def over_forces(grid) -> list[Change]:
    """The forces of a grid of cells."""
    names = ("f10", "f20")
    return [Change((f"{name}_range",), None, [f"{name}_hat"], getattr(grid, f"{name}_range")) for name in names]
