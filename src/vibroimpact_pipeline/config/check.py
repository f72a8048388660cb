"""A config, checked: everything that is wrong with it, in one line each."""

import reprlib

from pydantic import ValidationError

from vibroimpact_pipeline.config.messages import problems_of
from vibroimpact_pipeline.config.model import Config
from vibroimpact_pipeline.config.reading import ConfigError, read, unfit, written

MOST = 30
"""Lines that are shown at once."""
_BRIEF = reprlib.Repr()
_BRIEF.maxlist, _BRIEF.maxlevel = 100, 2


def checked(config: dict, origin: str = "--config", files=()) -> dict:
    """Return the plain values of a config as the model has them: numbers are numbers, defaults in, absent entries out.

    Args:
        config: all entries together.
        files: paths of the files that they are from, a later one over those before. origin: names what is in no file.

    Raises:
        ConfigError: something is wrong; a line for each problem, "origin: key: what".
    """
    contents = [(str(path), read(path)) for path in files]
    if not (found := unfit(config)):
        try:
            return Config.model_validate(_with_nulls(config)).model_dump(mode="json", exclude_none=True)
        except ValidationError as error:
            found = problems_of(error)
    found = sorted((written(place), _origin(place, config, contents) or origin, what) for place, what in found)
    more = [f"... and {len(found) - MOST} more"] if len(found) > MOST else []
    raise ConfigError("\n".join([f"{where}: {key}: {what}" for key, where, what in found[:MOST]] + more))


def _with_nulls(value):
    """Return values in which null is nothing: inside a mapping given by `--config`, Snakemake hands it over as text."""
    if isinstance(value, dict):
        return {key: _with_nulls(item) for key, item in value.items()}
    return [_with_nulls(item) for item in value] if isinstance(value, list) else None if value == "null" else value


def case_parameters(config: dict, case: str) -> dict:
    """Return the parameters of System for one case: those shared by all cases and its excitation amplitudes."""
    excitation = config["cases"][case]
    return {**config["system"], "f10_hat": excitation["f10_hat"], "f20_hat": excitation["f20_hat"]}


def with_key(error, decided: dict) -> str | None:
    """Return what the library says of an argument with the key of the config that it comes from; None if from none.

    Args:
        error: an error or its text, which begins with the name of an argument and a colon.
        decided: entries of the config by their whole key.
    """
    name, _, _ = str(error).partition(":")
    argument, _, _ = name.partition(".")
    holding = [key for key, value in decided.items() if isinstance(value, dict) and argument in value]
    holding += [key.removesuffix(f".{argument}") for key in decided if key.endswith(f".{argument}")]
    return f"{holding[0]}.{error}" if holding else None


def _origin(place, config, contents):
    """Return the last file that has what is at a place, or nearest to it where it is missing; None if none has it."""
    way = _way(config, place)
    for path, content in reversed(contents):
        there = _way(content, place)
        if len(there) == len(way) and (isinstance(way[-1], dict) or _BRIEF.repr(there[-1]) == _BRIEF.repr(way[-1])):
            return path
    return None


def _way(value, place):
    """Return the values on the way to a place, as far as they are there."""
    way = [value]
    for part in place:
        try:
            way.append(way[-1][part])
        except (LookupError, TypeError):
            break
    return way
