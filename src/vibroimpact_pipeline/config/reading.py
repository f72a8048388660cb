"""The plain values of a config file, and what can be said of them before the model looks at them."""

import yaml

LARGEST, MOST, DEEPEST, ALL = 100_000, 1000, 20, 50_000
"""Bytes of a file, entries of a mapping or list, levels of nesting, values in all (aliases make many of few)."""


class ConfigError(ValueError):
    """The config cannot be built; a line for each problem, with the place to mend it."""


class _Loader(yaml.SafeLoader):
    """YAML with every key given once."""

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
        for place, problem in unfit(config):
            raise ValueError(f"{written(place)}: {problem}")
        return config
    except OSError as error:
        what = error.strerror
    except yaml.MarkedYAMLError as error:
        mark = error.problem_mark or error.context_mark
        what = f"line {mark.line + 1}, column {mark.column + 1}: {error.problem}"
    except RecursionError:
        what = f"nested deeper than {DEEPEST} levels"
    except (ValueError, ArithmeticError, LookupError, yaml.YAMLError) as error:
        what = " ".join(str(error).split())
    raise ConfigError(f"{path}: {shown(what, plain=True)}")


def unfit(config) -> list[tuple[tuple, str]]:
    """Return the places of values that no config holds, dates say, or the first place that is too large or too deep."""
    found, waiting, values = [], [((), config)], 0
    while waiting:
        place, value = waiting.pop()
        if isinstance(value, dict | list):
            values += len(value)
            if len(value) > MOST or values > ALL or len(place) > DEEPEST:
                what = f"has more than {MOST} entries, {DEEPEST} levels or with all before {ALL} values"
                return [(place[:3], what)]
            items = value.items() if isinstance(value, dict) else enumerate(value)
            waiting += [((*place, key), item) for key, item in items]
        elif isinstance(value, bool) or not (value is None or isinstance(value, str | int | float)):
            found.append((place, f"{shown(value)} is not a number, text, list or mapping"))
    return found


def written(place) -> str:
    """Return a place as it is written: system.kappa, regimes.branches.paths[0]."""
    names = (f"[{part}]" if isinstance(part, int) else f".{shown(part, plain=True)}" for part in place)
    return "".join(names).removeprefix(".")


def shown(value, plain: bool = False) -> str:
    """Return a value as an error message shows it: on one line, with its middle left out where it is long."""
    plain = plain and str(value).isprintable()
    text = "nothing" if value is None else str(value) if plain else repr(value)
    return text if len(text) <= 120 else f"{text[:60]}...{text[-60:]}"
