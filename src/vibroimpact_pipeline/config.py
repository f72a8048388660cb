"""Checks of a pipeline config before anything runs: YAML, schema, and conditions across fields.

A problem is a pair (path of the key, what is wrong), for example ("system.kappa", "1.2 is not below 1").
"""

import difflib
import math
import reprlib

import yaml
from jsonschema import Draft202012Validator

from vibroimpact.system import System

KINDS = {"number": "a number", "integer": "a whole number", "string": "text", "object": "a mapping", "array": "a list"}


def parse(text: str) -> dict:
    """The config that a YAML text holds.

    Raises:
        ValueError: the text is not YAML, is not a mapping, or gives a key twice; with line and column.
    """
    try:
        config = yaml.load(text, _UniqueKeys)
    except yaml.MarkedYAMLError as error:
        mark = error.problem_mark or error.context_mark
        raise ValueError(f"line {mark.line + 1}, column {mark.column + 1}: {error.problem}") from None
    except yaml.YAMLError as error:
        raise ValueError(" ".join(str(error).split())) from None
    if not isinstance(config, dict):
        raise ValueError(f"{_show(config)} is not a mapping of system, cases and figures")
    return config


def typed(overrides):
    """Overrides with numbers as numbers: inside a mapping, the command line of Snakemake hands over text only."""
    if isinstance(overrides, dict):
        return {key: typed(value) for key, value in overrides.items()}
    if isinstance(overrides, list):
        return [typed(value) for value in overrides]
    return yaml.safe_load(overrides) if isinstance(overrides, str) else overrides


def case_parameters(config: dict, case: str) -> dict:
    """Parameters of System for one case: those shared by all cases and its excitation amplitudes."""
    excitation = config["cases"][case]
    return {**config["system"], "f10_hat": excitation["f10_hat"], "f20_hat": excitation["f20_hat"]}


def problems(config: dict, schema: dict) -> list[tuple[str, str]]:
    """Everything wrong with a config; conditions across fields are looked at once each field is right by itself."""
    return _against_schema(config, schema) or _across_fields(config)


def complaints(found: list[tuple[str, str]], origins: dict[str, dict]) -> list[str]:
    """One line per problem, with the place to mend it: the last of the origins that has the key, or the first of all.

    Args:
        origins: entries of the config by the name of what sets them; a later one overrides.
    """
    return [f"{_origin(path, origins)}: {path}: {what}" for path, what in found]


class _UniqueKeys(yaml.SafeLoader):
    """YAML in which a key given twice is an error."""

    def construct_mapping(self, node, deep=False):
        seen = set()
        for key, _ in node.value:
            if key.value in seen:
                raise yaml.constructor.ConstructorError(None, None, f"key {key.value!r} given twice", key.start_mark)
            seen.add(str(key.value))
        return super().construct_mapping(node, deep)


def _against_schema(config, schema):
    errors = sorted(Draft202012Validator(schema).iter_errors(config), key=lambda error: error.json_path)
    found = [problem for error in errors for problem in MESSAGES.get(error.validator, _other)(error)]
    return found + [(path, f"{value} is not finite") for path, value in _numbers(config) if not math.isfinite(value)]


def _across_fields(config):
    found = {}
    for case, settings in config["cases"].items():
        try:
            _refuse_resonance(System(**case_parameters(config, case)))
        except ValueError as error:
            name, _, what = str(error).partition(": ")
            found[f"system.{name}" if name in config["system"] else f"cases.{case}.{name}"] = what
        X1, Y1, X2, Y2 = settings["simulation"]["initial_state"][:4]
        for module, W in ((1, X1 - Y1), (2, X2 - Y2)):
            if abs(W) > 1:
                found[f"cases.{case}.simulation.initial_state"] = (
                    f"ball {module} starts beyond a wall: X{module} - Y{module} = {W} is not between -1 and 1"
                )
    for place, scene in _scenes(config):
        if "case" in scene and scene["case"] not in config["cases"]:
            found[f"{place}.case"] = f"unknown case {scene['case']!r}{_hint(scene['case'], config['cases'])}"
    return list(found.items())


def _refuse_resonance(system):
    """Refuse an undamped system whose periodic responses are not isolated, or not bounded."""
    if system.gamma1 > 0 and system.gamma2 > 0:
        return
    # Here, because SciPy takes longer to load than all else that a build with nothing to do needs.
    from vibroimpact.exact.orbits.impulse_response import ImpulseResponse
    from vibroimpact.theory.fixed_points.search import refuse_free_motion

    refuse_free_motion(system)
    if not system.has_undriven_module:
        for sign in (1, -1):
            ImpulseResponse(system, sign)


def _scenes(config):
    """Everything that may name a case, with its place."""
    yield from ((f"figures.{figure}", scene) for figure, scene in config["figures"].items())
    yield from ((f"regimes.{name}", config["regimes"][name]) for name in ("branches", "coexistence", "basins"))
    yield "regimes.epsilon.mixed", config["regimes"]["epsilon"]["mixed"]


def _type(error):
    expected = KINDS[error.validator_value]
    yield _path(error), f"{_show(error.instance)} is not {expected}{_exponent_hint(error.instance)}"


def _length(error):
    yield _path(error), f"has {len(error.instance)} entries, not {error.validator_value}"


def _unknown_keys(error):
    known = error.schema.get("properties", {})
    for key in error.instance:
        if key not in known:
            yield _path(error, key), f"unknown key{_hint(key, known)}"


def _missing_key(error):
    """A missing key, unless it is there but misspelt: that is reported once, as an unknown key."""
    key = error.message.split("'")[1]
    known = error.schema["properties"]
    if key not in {_nearest(given, known) for given in error.instance if given not in known}:
        yield _path(error, key), "missing"


def _other(error):
    yield _path(error), error.message


def _says(phrase):
    def message(error):
        yield _path(error), phrase.format(_show(error.instance), error.validator_value)

    return message


MESSAGES = {
    "minimum": _says("{} is below {}"),
    "maximum": _says("{} is above {}"),
    "exclusiveMinimum": _says("{} is not above {}"),
    "exclusiveMaximum": _says("{} is not below {}"),
    "const": _says("{} is not {!r}"),
    "pattern": _says("{} does not match {}"),
    "minProperties": _says("is empty"),
    "type": _type,
    "minItems": _length,
    "maxItems": _length,
    "additionalProperties": _unknown_keys,
    "required": _missing_key,
}


def _path(error, *more):
    names = [f"[{part}]" if isinstance(part, int) else f".{part}" for part in (*error.absolute_path, *more)]
    return "".join(names).removeprefix(".")


def _nearest(name, known):
    return next(iter(difflib.get_close_matches(str(name), list(known), n=1)), None)


def _hint(name, known):
    nearest = _nearest(name, known)
    return f", did you mean '{nearest}'?" if nearest else ""


def _exponent_hint(value):
    """YAML 1.1 takes 1e-3 for text; say how to write the number."""
    try:
        return f" (write {float(value)!r})" if isinstance(value, str) else ""
    except ValueError:
        return ""


def _show(value):
    return "nothing" if value is None else reprlib.repr(value)


def _numbers(value, path=""):
    """All floats in a config with their paths."""
    if isinstance(value, float):
        yield path, value
    elif isinstance(value, dict):
        for key, item in value.items():
            yield from _numbers(item, f"{path}.{key}" if path else str(key))
    elif isinstance(value, list):
        for index, item in enumerate(value):
            yield from _numbers(item, f"{path}[{index}]")


def _origin(path, origins):
    return next((name for name in reversed(origins) if _holds(origins[name], path)), next(iter(origins)))


def _holds(entries, path):
    for key in path.split("[")[0].split("."):
        if not isinstance(entries, dict) or key not in entries:
            return False
        entries = entries[key]
    return True
