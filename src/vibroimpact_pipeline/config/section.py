"""What all sections of the config have in common: no unknown keys, no infinite numbers, conditions across fields."""

import difflib
from collections.abc import Iterable, Iterator

from pydantic import BaseModel, ConfigDict, ValidationError, model_validator
from pydantic_core import InitErrorDetails, PydanticCustomError

Place = tuple[str | int, ...]
"""Keys and positions on the way to a value."""
Problem = tuple[Place, str]
"""Where something is wrong, and what."""


class Section(BaseModel):
    """A mapping of the config. Numbers may be texts, as `--config` hands them over; null stands for an absent entry."""

    model_config = ConfigDict(extra="forbid", allow_inf_nan=False)

    def conditions(self) -> Iterable[Problem]:
        """Yield what is wrong across fields, each of which is right by itself."""
        return ()

    def moves(self) -> Iterable[dict[str, float]]:
        """Yield what parameters of systems are changed to, by name."""
        return ()

    @model_validator(mode="before")
    @classmethod
    def _has_known_keys(cls, given):
        """Refused before the fields are looked at: a misspelt key is one problem, not a missing one besides."""
        if isinstance(given, dict) and cls.model_config["extra"] == "forbid":
            known = cls.model_fields
            refuse(cls, [((key,), f"unknown key{hint(key, known)}") for key in given if key not in known])
        return given

    @model_validator(mode="after")
    def _meets_conditions(self):
        refuse(type(self), self.conditions())
        return self


def refuse(section: type, problems: Iterable[Problem]) -> None:
    """Raise all problems at once, if there are any.

    Raises:
        pydantic.ValidationError: with an error per problem.
    """
    if errors := [InitErrorDetails(type=condition(what), loc=place, input=None) for place, what in problems]:
        raise ValidationError.from_exception_data(section.__name__, errors)


def condition(what: str) -> PydanticCustomError:
    """Return the error that says what is wrong."""
    return PydanticCustomError("condition", "{what}", {"what": what})


def hint(name, known: Iterable[str]) -> str:
    """Return a question whether the known name most like a given one was meant, if any is like it."""
    meant = difflib.get_close_matches(str(name), list(known), n=1)
    colon = "; a space belongs after a colon" if ":" in str(name) else ""
    return (f", did you mean {meant[0]!r}?" if meant else "") + colon


def sections(value, place: Place = (), case: str | None = None) -> Iterator[tuple[Place, Section, str | None]]:
    """Yield a section and all those below it, with their places and the case that they are about."""
    if isinstance(value, Section):
        case = getattr(value, "case", case)
        yield place, value, case
    for key, item in enumerate(value) if isinstance(value, list) else dict(value).items():
        if isinstance(item, Section | dict | list):
            yield from sections(item, (*place, key), case)


def above(place: Place, limit: float, what: str, **factors: float) -> list[Problem]:
    """Return the problem that so many (a product of what keys ask for) are more than a limit."""
    asked = 1
    for value in factors.values():
        asked *= value
    product = " x ".join(f"{value:.6g} {name}" for name, value in factors.items())
    return [(place, f"{product} = {asked:.3g} {what}, above {limit:.3g}")] if asked > limit else []
