"""Base class of the config's sections: known keys, and conditions across fields."""

from collections.abc import Iterable

from pydantic import BaseModel, ConfigDict, ValidationError, model_validator
from pydantic_core import InitErrorDetails, PydanticCustomError

Place = tuple[str | int, ...]
"""Keys and positions on the way to a value."""


class Section(BaseModel):
    """A mapping of the config. Numbers may be text, as `--config` passes them."""

    model_config = ConfigDict(extra="forbid", allow_inf_nan=False)

    def conditions(self) -> Iterable[tuple[Place, str]]:
        """Yield violated conditions between fields that are valid by themselves: the place, and the error."""
        return ()

    @model_validator(mode="after")
    def _meet_conditions(self):
        refuse(self.conditions())
        return self


def refuse(problems: Iterable[tuple[Place, str]]) -> None:
    """Raise Pydantic's error with these problems, each by its place; none, nothing."""
    kinds = [(place, PydanticCustomError("condition", "{what}", {"what": what})) for place, what in problems]
    if errors := [InitErrorDetails(type=kind, loc=place, input=None) for place, kind in kinds]:
        raise ValidationError.from_exception_data("config", errors)
