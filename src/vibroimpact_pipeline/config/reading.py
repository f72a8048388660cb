"""Reading and checking a config: all problems at once, one line each."""

import re
from importlib import import_module
from importlib.util import find_spec
from itertools import count

import yaml
from pydantic import ValidationError

from vibroimpact_pipeline.cases import with_cases
from vibroimpact_pipeline.config.messages import described, hint, problems_of, shown, written
from vibroimpact_pipeline.config.section import refuse

LARGEST, ALL = 100_000, 50_000
"""Bytes of a file, and its values (aliases make many of few)."""
MOST = 30
"""Lines that are shown at once."""


class ConfigError(ValueError):
    """The config is not valid; the message has a line for each problem, with the file and key."""


class _Loader(yaml.SafeLoader):
    """A YAML loader with keys as written; refuses duplicate keys, and numbers in octal or base 60."""

    def construct_mapping(self, node, deep=False):
        seen = set()
        for key in (key for key, _ in node.value if isinstance(key, yaml.ScalarNode)):
            if key.value in seen:
                raise yaml.MarkedYAMLError(problem=f"key {shown(key.value)} given twice", problem_mark=key.start_mark)
            seen.add(key.value)
            if key.tag != MERGE:
                key.tag = self.DEFAULT_SCALAR_TAG  # `no` would be false
        return super().construct_mapping(node, deep)

    def construct_number(self, node):
        text, kind = node.value, node.tag.rpartition(":")[2]
        number = getattr(super(), f"construct_yaml_{kind}")(node)
        if ":" in text or OCTAL.fullmatch(text):
            what = f"{shown(text, plain=True)} is {number} in YAML; write a decimal number, or a text in quotes"
            raise yaml.MarkedYAMLError(problem=what, problem_mark=node.start_mark)
        return number


MERGE, OCTAL = "tag:yaml.org,2002:merge", re.compile("[-+]?0[0-7_]+")
for kind in ("int", "float"):
    _Loader.add_constructor(f"tag:yaml.org,2002:{kind}", _Loader.construct_number)


def read(path) -> dict:
    """Return the entries of a config file; null stands for those that it removes.

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
        return _with_text_keys(config)
    except ValidationError as error:
        raise _refusal(error, [(path, config)]) from None
    except (OSError, ValueError, ArithmeticError, LookupError, RecursionError, yaml.YAMLError) as error:
        mark = getattr(error, "problem_mark", None) or getattr(error, "context_mark", None)
        place = f"line {mark.line + 1}, column {mark.column + 1}: " if mark else ""
        what = getattr(error, "strerror", None) or getattr(error, "problem", None) or str(error)
    raise ConfigError(f"{path}: {place}{shown(' '.join(what.split()), plain=True)}")


def merged(sources) -> dict:
    """Return the entries of some sources (name, content) together, a later one over those before.

    An entry of null removes that of the sources before. Inside a mapping given by `--config`, Snakemake hands null over
    as text.

    Raises:
        ConfigError: a null has nothing to remove, or a source has what no config has; a line for each.
    """
    whole = {}
    for name, content in sources:
        try:
            refuse(_update(whole, _with_text_keys(content), ()))
        except ValidationError as error:
            raise _refusal(error, [(name, content)]) from None
    return whole


def checked(config: dict, sources=()) -> dict:
    """Return the validated values of a config: numbers as numbers, defaults in.

    Args:
        config: all entries together, as `merged` returns them.
        sources: (name, content) of what they are from, a later one over those before.

    Raises:
        ConfigError: something is wrong; a line for each problem, "source: key: what".
    """
    try:
        whole = {}
        refuse(_update(whole, _with_text_keys(config), ()))
        values = with_cases(whole)
        cases = values["cases"] if isinstance(values.get("cases"), dict) else ()
        return model().model_validate(values, context=[*cases]).model_dump(mode="json", exclude_none=True)
    except ValidationError as error:
        raise _refusal(error, sources) from None


def model():
    """Return the model of the config: of both files, or of the chapter's alone where there are no studies."""
    if find_spec("vibroimpact_pipeline.studies"):
        return import_module("vibroimpact_pipeline.studies.config.model").Whole
    return import_module("vibroimpact_pipeline.config.model").Config


def _update(whole, content, above):
    """Update a config with entries whose keys are texts; return the problems of nulls that have nothing to remove."""
    problems = []
    for key, value in content.items():
        if value in (None, "null"):
            if key in whole:
                del whole[key]
            else:
                comma = "; a decimal number has a point" if key.isdecimal() else ""
                what = f"has no value, and no earlier source defines it{comma}{hint(key, whole)}"
                problems.append(((*above, key), what))
        elif isinstance(value, dict):
            within = whole.get(key)
            whole[key] = within if isinstance(within, dict) else {}
            problems += _update(whole[key], value, (*above, key))
        else:
            whole[key] = value
    return problems


def _refusal(error, sources):
    """Return the error with a line for each problem that Pydantic found, the first MOST."""
    found = sorted(problems_of(error).items(), key=lambda problem: written(problem[0]))
    lines = [f"{_source(place, sources)}: {written(place)}: {described(about)}" for place, about in found[:MOST]]
    return ConfigError("\n".join(lines + ([f"... and {len(found) - MOST} more"] if len(found) > MOST else [])))


def _source(place, sources):
    """Return the last source that has a place in the config, or else the first with the longest part of it."""

    def depth(source):
        value = source[1]
        for known, part in enumerate(place):
            try:
                value = value[part]
            except (LookupError, TypeError):
                return known
        return len(place)

    having = [name for name, content in sources if depth((name, content)) == len(place)]
    return having[-1] if having else max(sources, key=depth, default=["--config"])[0]


def _with_text_keys(config):
    """Return a copy of a config with its keys as texts.

    Raises:
        ValidationError: it has values that no config has, or too many.
    """
    found, values = [], count()

    def copied(value, place):
        if next(values) > ALL:
            refuse([(place[:3], f"has, with all before, more than {ALL} values")])
        if isinstance(value, dict):
            return {str(key): copied(item, (*place, key)) for key, item in value.items()}
        if isinstance(value, list):
            return [copied(item, (*place, number)) for number, item in enumerate(value)]
        if isinstance(value, bool) or not isinstance(value, str | int | float | None):
            found.append((place, f"{shown(value)} is not a number, text, list or mapping"))
        return value

    whole = copied(config, ())
    refuse(found)
    return whole
