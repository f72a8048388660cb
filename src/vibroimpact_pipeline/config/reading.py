"""Read and validate a config; report all problems together, each on one line."""

import re
from importlib import import_module
from importlib.util import find_spec
from itertools import count

import yaml
from pydantic import ValidationError

from vibroimpact_pipeline.cases import with_cases
from vibroimpact_pipeline.config.messages import described, hint, key_path, problems_of, short_repr
from vibroimpact_pipeline.config.section import refuse

MAX_BYTES, MAX_VALUES = 100_000, 50_000
"""Limits for a config file: its size, and its number of values after YAML aliases are expanded."""
MAX_LINES = 30
"""Maximum number of problems that an error message lists."""


class ConfigError(ValueError):
    """Raised if a config cannot be read or is invalid.

    The message lists up to MAX_LINES invalid entries, each on a line "file: key: problem".
    """


class _Loader(yaml.SafeLoader):
    """A YAML loader that keeps all keys as text.

    The loader rejects duplicate keys, octal numbers such as 017, and numbers in base 60 such as 1:30.
    """

    def construct_mapping(self, node, deep=False):
        seen = set()
        for key in (key for key, _ in node.value if isinstance(key, yaml.ScalarNode)):
            if key.value in seen:
                raise yaml.MarkedYAMLError(
                    problem=f"duplicate key {short_repr(key.value)}", problem_mark=key.start_mark
                )
            seen.add(key.value)
            if key.tag != MERGE:
                key.tag = self.DEFAULT_SCALAR_TAG  # otherwise, YAML would convert the key `no` to False
        return super().construct_mapping(node, deep)

    def construct_number(self, node):
        text, kind = node.value, node.tag.rpartition(":")[2]
        number = getattr(super(), f"construct_yaml_{kind}")(node)
        if ":" in text or OCTAL.fullmatch(text):
            what = f"{short_repr(text, plain=True)} means {number} in YAML; write a decimal number or a quoted text"
            raise yaml.MarkedYAMLError(problem=what, problem_mark=node.start_mark)
        return number


MERGE, OCTAL = "tag:yaml.org,2002:merge", re.compile("[-+]?0[0-7_]+")
for kind in ("int", "float"):
    _Loader.add_constructor(f"tag:yaml.org,2002:{kind}", _Loader.construct_number)


def read(path) -> dict:
    """Return the entries of a config file.

    Null values are kept, because each null tells `merged` to remove the entry of an earlier source.

    Raises
    ------
    ConfigError
        If the file is not a readable YAML mapping of supported values.
    """
    try:
        with open(path, "rb") as file:
            content = file.read(MAX_BYTES + 1)
        if len(content) > MAX_BYTES:
            raise ValueError(f"file is larger than {MAX_BYTES} bytes")
        config = yaml.load(content.decode("utf-8"), _Loader)
        if not isinstance(config, dict):
            raise ValueError(f"{short_repr(config)} should be a mapping with the keys system, cases, figures, ...")
        return _with_text_keys(config)
    except ValidationError as error:
        raise _refusal(error, [(path, config)]) from None
    except (OSError, ValueError, ArithmeticError, LookupError, RecursionError, yaml.YAMLError) as error:
        mark = getattr(error, "problem_mark", None) or getattr(error, "context_mark", None)
        place = f"line {mark.line + 1}, column {mark.column + 1}: " if mark else ""
        what = getattr(error, "strerror", None) or getattr(error, "problem", None) or str(error)
    raise ConfigError(f"{path}: {place}{short_repr(' '.join(what.split()), plain=True)}")


def merged(sources) -> dict:
    """Merge config sources, given as pairs (name, content); later sources override earlier ones.

    The value null removes the entry of an earlier source. The text "null" has the same effect, because Snakemake
    converts a null in `--config` to this text.

    Raises
    ------
    ConfigError
        If a null has no entry to remove, or if a source contains unsupported values.
    """
    whole = {}
    for name, content in sources:
        try:
            refuse(_update(whole, _with_text_keys(content), ()))
        except ValidationError as error:
            raise _refusal(error, [(name, content)]) from None
    return whole


def checked(config: dict, sources=()) -> dict:
    """Validate a config; return its values with defaults filled in.

    If `sources` are given, as pairs (name, content), error messages name the source of each invalid entry.

    Raises
    ------
    ConfigError
        If the config is invalid.
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
    """Return the class that validates the config: `Whole`, or `Config` if the studies are not installed."""
    if find_spec("vibroimpact_pipeline.studies"):
        return import_module("vibroimpact_pipeline.studies.config.model").Whole
    return import_module("vibroimpact_pipeline.config.model").Config


def _update(whole, content, above):
    """Update the mapping `whole` in place with the entries of `content`; the value null removes an entry of `whole`.

    `above` is the key path of `whole` in the config. Return a list of pairs (key path, message), one for each null
    that has no entry to remove.
    """
    problems = []
    for key, value in content.items():
        if value in (None, "null"):
            if key in whole:
                del whole[key]
            else:
                comma = "; use a point as decimal separator" if key.isdecimal() else ""
                what = f"null removes an entry of an earlier source, but none defines this key{comma}{hint(key, whole)}"
                problems.append(((*above, key), what))
        elif isinstance(value, dict):
            within = whole.get(key)
            whole[key] = within if isinstance(within, dict) else {}
            problems += _update(whole[key], value, (*above, key))
        else:
            whole[key] = value
    return problems


def _refusal(error, sources):
    """Return a ConfigError that lists the problems found by Pydantic, one per line and at most MAX_LINES of them."""
    found = sorted(problems_of(error).items(), key=lambda problem: key_path(problem[0]))
    lines = [f"{_source(place, sources)}: {key_path(place)}: {described(about)}" for place, about in found[:MAX_LINES]]
    return ConfigError(
        "\n".join(lines + ([f"... and {len(found) - MAX_LINES} more"] if len(found) > MAX_LINES else []))
    )


def _source(place, sources):
    """Return the name of the last source that contains a key path.

    If no source contains the whole path, return the name of the source that contains the most leading keys of the path.
    """

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
    """Return a copy of a config with all keys converted to text.

    Raises
    ------
    ValidationError
        If the config has values of an unsupported type, or more than MAX_VALUES values.
    """
    found, values = [], count()

    def copied(value, place):
        if next(values) > MAX_VALUES:
            refuse([(place[:3], f"the config has more than {MAX_VALUES} values up to here")])
        if isinstance(value, dict):
            return {str(key): copied(item, (*place, key)) for key, item in value.items()}
        if isinstance(value, list):
            return [copied(item, (*place, number)) for number, item in enumerate(value)]
        if isinstance(value, bool) or not isinstance(value, str | int | float | None):
            found.append((place, f"{short_repr(value)} should be a number, text, list or mapping"))
        return value

    whole = copied(config, ())
    refuse(found)
    return whole
