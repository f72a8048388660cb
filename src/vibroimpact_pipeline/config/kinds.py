"""Kinds of values that several sections have, with their limits."""

from typing import Annotated

from pydantic import AfterValidator, Field

from vibroimpact_pipeline.config.section import Section, condition


def needs(fits, what: str) -> AfterValidator:
    """Return a validator that accepts values for which `fits` is true, with a message for others."""

    def check(value):
        if not fits(value):
            raise condition(f"{'' if isinstance(value[0], Section) else value} {what}".lstrip())
        return value

    return AfterValidator(check)


NAME, CASE = "^[a-z][a-z0-9_]{1,39}$", "^[a-z][a-z0-9_-]{1,39}$"
TITLE, LETTER = "^[A-Za-z][A-Za-z0-9 ,()-]{0,39}$", "^[a-z]$"
HIGHEST = 1.69
"""Beyond the derived limits of the companions, the highest of which is pi^2 / (pi^2 - 4) = 1.68."""
WORDS = {
    CASE: "a name of a case: a small letter, then 1 to 39 small letters, digits, - and _",
    NAME: "a name: a small letter, then 1 to 39 small letters, digits and _",
    TITLE: "a title: a letter, then up to 39 letters, digits, spaces and , ( ) -",
    LETTER: "one small letter",
}
"""Description of each pattern."""
ASCENDING = needs(lambda ends: ends[0] < ends[1], "is no range: its first end is not below its second")
DIFFERENT = needs(lambda values: all(one not in values[:n] for n, one in enumerate(values)), "has a value twice")
WITHIN_WALLS = needs(
    lambda at: abs(at[0] - at[1]) <= 1 and abs(at[2] - at[3]) <= 1,
    "starts a ball beyond a wall: X1 - Y1 and X2 - Y2 are between -1 and 1",
)


def items(kind, least: int, most: int, about: str | None = None, check: AfterValidator | None = DIFFERENT):
    """Return the type of a list, with distinct values unless another check is given."""
    return Annotated[list[kind], Field(min_length=least, max_length=most, description=about), check]


def span(kind, about: str = "Where it begins and ends"):
    """Return the type of a list of a lower and an upper end."""
    return items(kind, 2, 2, about, ASCENDING)


def around(low: float, high: float):
    """Return the type of a list of two ends, the first at most `low`, the second at least `high`."""
    return tuple[Annotated[float, Field(ge=0, le=low)], Annotated[float, Field(ge=high, le=100)]]


def named(kind, least: int, most: int, name: str = NAME):
    """Return the type of a mapping with free names; a null entry removes the default one (see `reading`)."""
    free = Annotated[str, Field(pattern=name)]
    return Annotated[dict[free, kind | None], Field(min_length=least, max_length=most)]


Title = Annotated[str, Field(pattern=TITLE)]
CaseName = Annotated[str, Field(description="Name of a case; absent: default_case")]
Label = Annotated[str, Field(pattern=LETTER, description="Label of a fixed point of the case, from a on")]
Force = Annotated[float, Field(ge=-1000, le=1000)]
Forces = span(Force, "Lower and upper end of the forces")
Number = Annotated[float, Field(ge=-1e6, le=1e6)]
Epsilon = Annotated[float, Field(ge=1e-6, le=10, description="Mass of a ball over that of its box")]
Amplitude = Annotated[float, Field(gt=1, le=100)]
Cycles = Annotated[int, Field(ge=1, le=1_000_000)]
Planes = items(Amplitude, 2, 2, "Right ends of the planes (C_1, B_1) and (C_2, B_2), beyond the fold", None)
START = "Start [X1, Y1, X2, Y2, X1', Y1', X2', Y2']; the balls between their walls"
State = items(Force, 8, 8, START, WITHIN_WALLS)


class ForceGrid(Section):
    """Cells of a plane of forces."""

    f10_range: Forces
    f20_range: Forces
    points: int = Field(ge=2, le=1000, description="Cells along each axis")


class Starts(Section):
    """Initial states of motions."""

    starts: int = Field(ge=1, le=10_000, description="Starts, spread evenly; the first is rest")
    seed: int = Field(ge=0, le=2**32 - 1, description="Scrambles the starts")
