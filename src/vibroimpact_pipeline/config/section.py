"""What all sections of the config have in common: no unknown keys, no conversions, conditions across fields."""

import re
from collections.abc import Iterable, Iterator
from typing import NamedTuple

from pydantic import BaseModel, ConfigDict, ValidationError, model_validator
from pydantic_core import InitErrorDetails, PydanticCustomError

from vibroimpact_pipeline.config.text import show

Place = tuple[str | int, ...]
"""Keys and positions on the way to a value."""


class Problem(NamedTuple):
    """What is wrong, and where."""

    place: Place
    what: str


class Change(NamedTuple):
    """Values that parameters move through together; they have to stay those of a system all the way.

    place: of the list of values. case: whose other parameters are kept, every case's for None.
    """

    place: Place
    case: str | None
    along: list[str]
    values: list[float]


def written(place: Place) -> str:
    """A place as it is written: system.kappa, regimes.branches.paths[0]."""
    names = [f"[{part}]" if isinstance(part, int) else f".{_key(part)}" for part in place]
    return "".join(names).removeprefix(".")


def _key(name):
    return name if re.fullmatch(r"[\w ,()-]{1,60}", name) else show(name)


class Section(BaseModel):
    """A mapping of the config. A number is a number, never a text or a truth value that could be made into one."""

    model_config = ConfigDict(extra="forbid", strict=True, allow_inf_nan=False)

    def conditions(self) -> Iterable[Problem]:
        """What is wrong across fields, each of which is right by itself."""
        return ()

    def changes(self) -> Iterable[Change]:
        """What parameters are changed to."""
        return ()

    @model_validator(mode="after")
    def _meets_conditions(self):
        refuse(self, self.conditions())
        return self


def refuse(section, problems: Iterable[Problem]) -> None:
    """Raise all problems at once, if there are any.

    Raises:
        pydantic.ValidationError: with an error per problem.
    """
    errors = [
        InitErrorDetails(type=PydanticCustomError("condition", "{what}", {"what": what}), loc=place, input=None)
        for place, what in problems
    ]
    if errors:
        raise ValidationError.from_exception_data(type(section).__name__, errors)


def sections(value, place: Place = ()) -> Iterator[tuple[Place, Section]]:
    """A section and all those below it, with their places."""
    if isinstance(value, Section):
        yield place, value
    for key, item in _items(value):
        yield from sections(item, (*place, key))


def marked(value, mark: type) -> Iterator[tuple[Place, object]]:
    """All values in fields that bear a mark, with their places."""
    for place, section in sections(value):
        for name, field in type(section).model_fields.items():
            if any(isinstance(entry, mark) for entry in field.metadata):
                yield (*place, name), getattr(section, name)


def _items(value):
    """Pairs of key and value below a value."""
    if isinstance(value, Section | dict):
        return list(value) if isinstance(value, Section) else value.items()
    return enumerate(value) if isinstance(value, list) else ()
