"""Reading and checking a config: all problems at once, one line each."""

from itertools import count

import yaml
from pydantic import ValidationError

from vibroimpact_pipeline.cases import with_cases
from vibroimpact_pipeline.config.messages import problems_of, shown, written

LARGEST, DEEPEST, ALL = 100_000, 20, 50_000
"""Bytes of a file, levels of nesting, values in all (aliases make many of few)."""
MOST = 30
"""Lines that are shown at once."""


class ConfigError(ValueError):
    """The config is not valid; the message has a line for each problem, with the file and key."""


class _Loader(yaml.SafeLoader):
    """A YAML loader that refuses duplicate keys."""

    def construct_mapping(self, node, deep=False):
        seen = set()
        for key in (key for key, _ in node.value if isinstance(key, yaml.ScalarNode)):
            if key.value in seen:
                raise yaml.MarkedYAMLError(problem=f"key {shown(key.value)} given twice", problem_mark=key.start_mark)
            seen.add(key.value)
        return super().construct_mapping(node, deep)


def read(path) -> dict:
    """Return the entries of a config file.

    Raises:
        ConfigError: the file cannot be read, is not a mapping in YAML, or holds what no config does; in one line.
    """
    try:
        with open(path, "rb") as file:
            content = file.read(LARGEST + 1)
        if len(content) > LARGEST:
            raise ValueError(f"has more than {LARGEST} bytes")
        config = yaml.load(content.decode("utf-8"), _Loader)
        if not isinstance(config, dict):
            raise ValueError(f"{shown(config)} is not a mapping of system, cases and figures")
        for place, problem in cleared(config)[1]:
            raise ValueError(f"{written(place)}: {problem}")
        return config
    except (OSError, ValueError, ArithmeticError, LookupError, RecursionError, yaml.YAMLError) as error:
        mark = getattr(error, "problem_mark", None) or getattr(error, "context_mark", None)
        place = f"line {mark.line + 1}, column {mark.column + 1}: " if mark else ""
        what = getattr(error, "strerror", None) or getattr(error, "problem", None) or str(error)
    raise ConfigError(f"{path}: {place}{shown(' '.join(what.split()), plain=True)}")


def checked(config: dict, sources=()) -> dict:
    """Return the validated values of a config: numbers as numbers, defaults in, removed entries out.

    Args:
        config: all entries together.
        sources: (name, content) of what they are from, a later one over those before.

    Raises:
        ConfigError: something is wrong; a line for each problem, "source: key: what".
    """
    from vibroimpact_pipeline.config.model import Config

    values, found = cleared(config)
    try:
        if not found:
            return Config.model_validate(with_cases(values)).model_dump(mode="json", exclude_none=True)
    except ValidationError as error:
        found = problems_of(error)
    more = [f"... and {len(found) - MOST} more"] if len(found) > MOST else []
    told = sorted((written(place), _source(place, sources), what) for place, what in found)[:MOST]
    raise ConfigError("\n".join([f"{source}: {key}: {what}" for key, source, what in told] + more))


def cleared(config) -> tuple[dict, list]:
    """Return a config without entries of null, which remove others, and the problems of unsupported values.

    Inside a mapping given by `--config`, Snakemake hands null over as text.
    """
    found, values = {}, count()

    def clear(value, place):
        if next(values) > ALL or len(place) > DEEPEST:
            found[place[:3]] = f"has more than {DEEPEST} levels or, with all before, {ALL} values"
        elif isinstance(value, dict):
            return {key: clear(item, (*place, key)) for key, item in value.items() if item not in (None, "null")}
        elif isinstance(value, list):
            return [clear(item, (*place, number)) for number, item in enumerate(value)]
        elif isinstance(value, bool) or not isinstance(value, str | int | float | None):
            found[place] = f"{shown(value)} is not a number, text, list or mapping"
        return value

    return clear(config, ()), list(found.items())


def _source(place, sources):
    """Return the last source that has a place in the config; if none has, the last file with the longest part of it.

    What is in no file is the last source: a missing key is told of it only where no file comes as near.
    """

    def depth(source):
        value = source[1]
        for known, part in enumerate(place):
            try:
                value = value[part]
            except (LookupError, TypeError):
                return known
        return len(place)

    having = [source for source in sources if depth(source) == len(place)]
    files_first = [*reversed(sources[:-1]), *sources[-1:]]
    return having[-1][0] if having else max(files_first, key=depth, default=["--config"])[0]
