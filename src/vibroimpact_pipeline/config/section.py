"""Base class of the config's sections: known keys, and conditions across fields."""

import difflib
from collections.abc import Iterable, Iterator
from typing import ClassVar

from pydantic import BaseModel, ConfigDict, ValidationError, model_validator
from pydantic_core import InitErrorDetails, PydanticCustomError

Place = tuple[str | int, ...]
"""Keys and positions on the way to a value."""
Problem = tuple[Place, str]
"""Place of a problem, and its message."""


class Section(BaseModel):
    """A mapping of the config. Numbers may be text, as `--config` passes them."""

    model_config = ConfigDict(extra="forbid", allow_inf_nan=False)

    rules: ClassVar = ()
    """Conditions across fields, as expressions in these, each after the key that is told where it does not hold."""

    def conditions(self) -> Iterable[Problem]:
        """Yield violated conditions between fields that are valid by themselves."""
        for key, rule in self.rules:
            if not eval(rule, dict(self)):  # a constant of this code, which the message quotes
                given = getattr(self, key)
                yield (key,), (f"{given} is given; " if isinstance(given, int | float) else "") + f"{rule} is needed"

    def moves(self) -> Iterable[dict[str, float]]:
        """Yield changed parameters of systems by name."""
        return ()

    @model_validator(mode="wrap")
    @classmethod
    def _meets_conditions(cls, given, validate):
        """Report unknown keys first: a misspelt key is one problem, not also a missing one."""
        known = cls.model_fields
        if isinstance(given, dict) and cls.model_config["extra"] == "forbid":
            _refuse([((key,), f"unknown key{hint(key, known)}") for key in given if key not in known])
        section = validate(given)
        _refuse(section.conditions())
        return section


def _refuse(problems):
    if errors := [InitErrorDetails(type=condition(what), loc=place, input=None) for place, what in problems]:
        raise ValidationError.from_exception_data("config", errors)


def condition(what: str) -> PydanticCustomError:
    """Return the validation error with this message."""
    return PydanticCustomError("condition", "{what}", {"what": what})


def hint(name, known: Iterable[str]) -> str:
    """Return "did you mean ...?" with the most similar known name, or nothing if none is similar."""
    meant = difflib.get_close_matches(str(name), list(known), n=1)
    colon = "; a space belongs after a colon" if ":" in str(name) else ""
    return (f", did you mean {meant[0]!r}?" if meant else "") + colon


def sections(value, place: Place = (), case: str | None = None) -> Iterator[tuple[Place, Section, str | None]]:
    """Yield a section and all sections below it, each with its place and its case."""
    if isinstance(value, Section):
        case = getattr(value, "case", case)
        yield place, value, case
    for key, item in enumerate(value) if isinstance(value, list) else dict(value).items():
        if isinstance(item, Section | dict | list):
            yield from sections(item, (*place, key), case)
