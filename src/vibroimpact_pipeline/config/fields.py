"""Types of config values that several sections of the config use; the types include limits of the values."""

from typing import Annotated

from pydantic import AfterValidator, Field, ValidationInfo

NAME, CASE = "^[a-z][a-z0-9_]{1,39}$", "^[a-z][a-z0-9_-]{1,39}$"
TITLE, LETTER = "^[A-Za-z][A-Za-z0-9 ,()-]{0,39}$", "^[a-z]$"
BEYOND_LIMITS = 1.69
"""Value of C above the stability limits derived in docs/stability.md, the larger of which is 1.6815."""
MAX_VALUES = 1000
"""Maximum number of values of a varied quantity; only a sweep axis with a range may have more."""


def needs(fits, what: str) -> AfterValidator:
    """Return a validator that raises ValueError(what) for a value unless fits(value) is True."""

    def check(value):
        if not fits(value):
            raise ValueError(what)
        return value

    return AfterValidator(check)


def _known(case: str, info: ValidationInfo):
    """Return the name of a case; raise ValueError if the config has no such case.

    The validation context lists the names of the cases. If the context is empty, every name is accepted.
    """
    if case not in (info.context or [case]):
        raise ValueError(f"should be one of the cases {', '.join(map(repr, info.context))}")
    return case


ASCENDING = needs(lambda ends: ends[0] < ends[1], "should be a range [low, high] with low < high")
DIFFERENT = needs(
    lambda values: all(one not in values[:n] for n, one in enumerate(values)), "should contain no value twice"
)
WITHIN_WALLS = needs(
    lambda at: abs(at[0] - at[1]) <= 1 and abs(at[2] - at[3]) <= 1,
    "should have X1 - Y1 and X2 - Y2 between -1 and 1, so that both balls start between their walls",
)


def items(kind, least: int, most: int, about: str | None = None, check: AfterValidator | None = DIFFERENT):
    """Return the type of a list of `least` to `most` values.

    The validator `check` applies to the list. By default, the list must not contain a value twice.
    """
    return Annotated[list[kind], Field(min_length=least, max_length=most, description=about), check]


def span(kind, about: str = "Lower and upper end"):
    """Return the type of a range [low, high] with low < high."""
    return items(kind, 2, 2, about, ASCENDING)


def named(kind, least: int, most: int, name: str = NAME):
    """Return the type of a mapping whose keys match the pattern `name`.

    A value may be null. If several config files are combined, null removes an entry that an earlier file sets.
    """
    free = Annotated[str, Field(pattern=name)]
    return Annotated[dict[free, kind | None], Field(min_length=least, max_length=most)]


def count(about: str, least: int = 1, most: int = 1_000_000):
    """Return the type of an integer from `least` to `most`."""
    return Annotated[int, Field(ge=least, le=most, description=about)]


def real(about: str, least: float = 0.0, most: float = 10_000.0):
    """Return the type of a real number from `least` to `most`."""
    return Annotated[float, Field(ge=least, le=most, description=about)]


Title = Annotated[str, Field(pattern=TITLE, description="Name of the case in titles and captions; default: its key")]
CaseName = Annotated[str, AfterValidator(_known), Field(description="Name of a case; default: default_case")]
Label = Annotated[str, Field(pattern=LETTER, description="Label of a fixed point of the case: a, b, c, ...")]
Force = Annotated[float, Field(ge=-1000, le=1000)]
Forces = span(Force, "Lower and upper end of the forcing amplitude")
Number = Annotated[float, Field(ge=-1e6, le=1e6)]
Epsilon = real("Mass ratio of ball and box, m / M", 1e-6, 10)
Amplitude = Annotated[float, Field(gt=1, le=100)]
Planes = items(
    Amplitude, 2, 2, "Right ends of the planes (C_1, B_1) and (C_2, B_2), above the fold of the manifold", None
)
START = "Initial state [X1, Y1, X2, Y2, X1', Y1', X2', Y2'], with both balls between their walls"
State = items(Force, 8, 8, START, WITHIN_WALLS)
Starts = count("Number of initial states, evenly spread; the first is the state of rest", 1, 10_000)
Seed = count("Seed for scrambling the initial states", 0, 2**32 - 1)
Points = count("Number of cells or initial states along each axis of a plane", 2, 200)
