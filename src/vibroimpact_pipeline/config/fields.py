"""Kinds of values that several sections have, with their limits."""

from typing import Annotated

from pydantic import AfterValidator, BeforeValidator, Field

from vibroimpact_pipeline.config.section import Section, condition

NAME, TITLE, LETTER = "^[a-z][a-z0-9_]{1,39}$", "^[A-Za-z][A-Za-z0-9 ,()-]{0,39}$", "^[a-z]$"
WORDS = {
    NAME: "a name: a small letter, then 1 to 39 small letters, digits and _",
    TITLE: "a title: a letter, then up to 39 letters, digits, spaces and , ( ) -",
    LETTER: "one small letter",
}
"""What texts have to look like, in words."""


def _ascending(ends):
    if not ends[0] < ends[1]:
        raise condition(f"{ends} is no range: {ends[0]} is not below {ends[1]}")
    return ends


def _different(values):
    for place, value in enumerate(values):
        if value in values[:place]:
            raise condition(f"{value} stands there twice")
    return values


def _within_walls(state):
    for module, W in ((1, state[0] - state[1]), (2, state[2] - state[3])):
        if abs(W) > 1:
            raise condition(f"ball {module} starts beyond a wall: X{module} - Y{module} = {W} is not between -1 and 1")
    return state


def items(kind, least: int, most: int, about: str | None = None, check=_different):
    """Return the type of a list, of different values unless something else is checked."""
    return Annotated[list[kind], Field(min_length=least, max_length=most, description=about), AfterValidator(check)]


def span(kind, about: str = "Where it begins and ends"):
    """Return the type of a list of a lower and an upper end."""
    return items(kind, 2, 2, about, _ascending)


def around(low: float, high: float):
    """Return the type of a list of two ends, one at most `low`, one at least `high`."""
    return tuple[Annotated[float, Field(ge=0, le=low)], Annotated[float, Field(ge=high, le=100)]]


def named(kind, least: int, most: int, name: str = NAME):
    """Return the type of a mapping with free names, of which null takes an entry away."""

    def counted(given):
        number = sum(item is not None for item in given.values()) if isinstance(given, dict) else least
        if not least <= number <= most:
            raise condition(f"has {number} entries, more than {most}" if number else "is empty")
        return given

    taken_away = AfterValidator(lambda entries: {key: item for key, item in entries.items() if item is not None})
    free = Annotated[str, Field(pattern=name)]
    return Annotated[dict[free, kind | None], taken_away, BeforeValidator(counted)]


CaseName = Annotated[str, Field(description="Name of a case")]
Label = Annotated[str, Field(pattern=LETTER, description="Label of a fixed point of the case, from a on")]
Force = Annotated[float, Field(ge=-1000, le=1000)]
Forces = span(Force, "Lower and upper end of the forces")
Number = Annotated[float, Field(ge=-1e6, le=1e6)]
Epsilon = Annotated[float, Field(ge=1e-6, le=10, description="Mass of a ball over that of its box")]
Amplitude = Annotated[float, Field(gt=1, le=100)]
Planes = items(Amplitude, 2, 2, "Right ends of the planes (C_1, B_1) and (C_2, B_2), beyond the fold", list)
START = "Start [X1, Y1, X2, Y2, X1', Y1', X2', Y2']; the balls between their walls"
State = items(Force, 8, 8, START, _within_walls)


class Motion(Section):
    """A motion from its start."""

    case: CaseName
    initial_state: State


class ForceGrid(Section):
    """Cells of a plane of forces."""

    f10_range: Forces
    f20_range: Forces
    points: int = Field(ge=2, le=1000, description="Cells along each axis")


class Starts(Section):
    """States that motions start from."""

    starts: int = Field(ge=1, le=10_000, description="Starts, spread evenly; the first is rest")
    seed: int = Field(ge=0, le=2**32 - 1, description="Scrambles the starts")
