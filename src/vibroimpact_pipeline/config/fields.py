"""Types of fields that several sections have, with their limits."""

from typing import Annotated

from pydantic import AfterValidator, Field, ValidationInfo

NAME, CASE = "^[a-z][a-z0-9_]{1,39}$", "^[a-z][a-z0-9_-]{1,39}$"
TITLE, LETTER = "^[A-Za-z][A-Za-z0-9 ,()-]{0,39}$", "^[a-z]$"
HIGHEST = 1.69
"""Beyond the derived limits of the companions, the highest of which is pi^2 / (pi^2 - 4) = 1.68."""
MOST = 1000
"""Values along an axis."""


def needs(fits, what: str) -> AfterValidator:
    """Return a validator that accepts values for which `fits` is true, with a message for others."""

    def check(value):
        if not fits(value):
            raise ValueError(what)
        return value

    return AfterValidator(check)


def _known(case: str, info: ValidationInfo):
    """Return a case that is in the context of the validation, the cases of the config; without one, any."""
    if case not in (info.context or [case]):
        raise ValueError(f"should be a case: {', '.join(map(repr, info.context))}")
    return case


ASCENDING = needs(lambda ends: ends[0] < ends[1], "should be a range, its first end below its second")
DIFFERENT = needs(lambda values: all(one not in values[:n] for n, one in enumerate(values)), "should repeat no value")
WITHIN_WALLS = needs(
    lambda at: abs(at[0] - at[1]) <= 1 and abs(at[2] - at[3]) <= 1,
    "should start no ball beyond a wall: X1 - Y1 and X2 - Y2 are between -1 and 1",
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


def count(about: str, least: int = 1, most: int = 1_000_000):
    """Return the type of a number of things, from `least` to `most`."""
    return Annotated[int, Field(ge=least, le=most, description=about)]


def real(about: str, least: float = 0.0, most: float = 10_000.0):
    """Return the type of a number from `least` to `most`."""
    return Annotated[float, Field(ge=least, le=most, description=about)]


Title = Annotated[str, Field(pattern=TITLE, description="What titles and captions call the case; absent: its name")]
CaseName = Annotated[str, AfterValidator(_known), Field(description="Name of a case; absent: default_case")]
Label = Annotated[str, Field(pattern=LETTER, description="Label of a fixed point of the case, from a on")]
Force = Annotated[float, Field(ge=-1000, le=1000)]
Forces = span(Force, "Lower and upper end of the forces")
Number = Annotated[float, Field(ge=-1e6, le=1e6)]
Epsilon = real("Mass of a ball over that of its box", 1e-6, 10)
Amplitude = Annotated[float, Field(gt=1, le=100)]
Planes = items(Amplitude, 2, 2, "Right ends of the planes (C_1, B_1) and (C_2, B_2), beyond the fold", None)
START = "Start [X1, Y1, X2, Y2, X1', Y1', X2', Y2']; the balls between their walls"
State = items(Force, 8, 8, START, WITHIN_WALLS)
Starts = count("Starts, spread evenly; the first is rest", 1, 10_000)
Seed = count("Scrambles the starts", 0, 2**32 - 1)
Points = count("Cells or starts along each axis of a plane", 2, 200)
