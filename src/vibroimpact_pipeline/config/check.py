"""A config, checked: everything that is wrong with it, in one line each."""

from collections.abc import Iterable

from pydantic import ValidationError

from vibroimpact_pipeline.config.labels import Labels, labels, without_fixed_points
from vibroimpact_pipeline.config.messages import problems_of
from vibroimpact_pipeline.config.model import Config
from vibroimpact_pipeline.config.schema import keys_at
from vibroimpact_pipeline.config.section import written
from vibroimpact_pipeline.config.text import read

MOST = 30
"""Lines that are shown at once."""


def checked(path) -> dict:
    """The config in a file, if nothing is wrong with it.

    Raises:
        ValueError: something is; a line for each problem.
    """
    try:
        config = read(path)
    except ValueError as error:
        raise ValueError(f"{path}: {error}") from None
    if found := problems(config):
        raise ValueError("\n".join(complaints(found, {str(path): config})))
    return config


def problems(config: dict, labels: Labels = labels) -> list[tuple[str, str]]:
    """Everything wrong with a config: pairs (path of the key, what is wrong), ("system.kappa", "missing") say.

    Conditions across fields are looked at once each field of a section is right by itself, the fixed points that it
    names once all else is right.
    """
    try:
        found = without_fixed_points(Config.model_validate(config), labels)
    except ValidationError as error:
        found = problems_of(error, config, keys_at)
    return sorted((written(place), what) for place, what in found)


def complaints(found: Iterable[tuple[str, str]], origins: dict[str, dict]) -> list[str]:
    """One line per problem, with the place to mend it: the last origin that has the key, or the one that goes nearest.

    Args:
        origins: entries of the config by the name of what sets them; a later one overrides.
    """
    lines = [f"{_origin(path, origins)}: {path}: {what}" for path, what in found]
    return lines if len(lines) <= MOST else [*lines[:MOST], f"... and {len(lines) - MOST} more"]


def case_parameters(config: dict, case: str) -> dict:
    """Parameters of System for one case: those shared by all cases and its excitation amplitudes."""
    excitation = config["cases"][case]
    return {**config["system"], "f10_hat": excitation["f10_hat"], "f20_hat": excitation["f20_hat"]}


def _origin(path, origins):
    left = {name: _left(entries, path) for name, entries in origins.items()}
    having = [name for name, rest in left.items() if not rest or rest.startswith("[")]
    return having[-1] if having else min(left, key=lambda name: len(left[name]))


def _left(entries, path):
    """What is left of a path after the keys, one within the other, that are there."""
    for key, value in entries.items() if isinstance(entries, dict) else ():
        name = written((key,))
        if path == name or path.startswith((f"{name}.", f"{name}[")):
            return _left(value, path.removeprefix(name).removeprefix("."))
    return path
