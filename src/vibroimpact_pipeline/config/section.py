"""Base class of config sections; the class rejects unknown keys and checks conditions that involve several fields."""

from collections.abc import Iterable

from pydantic import BaseModel, ConfigDict, ValidationError, model_validator
from pydantic_core import InitErrorDetails, PydanticCustomError

Place = tuple[str | int, ...]
"""Path to a value: keys of mappings and indices of lists."""


class Section(BaseModel):
    """A section of the config, which is a mapping.

    A number may be written as text, since Snakemake passes some numbers of `--config` as text.
    """

    model_config = ConfigDict(extra="forbid", allow_inf_nan=False)

    def conditions(self) -> Iterable[tuple[Place, str]]:
        """Return a pair (key path, message) for each violated condition that involves several fields.

        The method is called only if each single field is valid.
        """
        return ()

    @model_validator(mode="after")
    def _meet_conditions(self):
        refuse(self.conditions())
        return self


def refuse(problems: Iterable[tuple[Place, str]]) -> None:
    """Raise Pydantic's ValidationError if `problems`, an iterable of pairs (key path, message), is not empty."""
    kinds = [(place, PydanticCustomError("condition", "{what}", {"what": what})) for place, what in problems]
    if errors := [InitErrorDetails(type=kind, loc=place, input=None) for place, kind in kinds]:
        raise ValidationError.from_exception_data("config", errors)
