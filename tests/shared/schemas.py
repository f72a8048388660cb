"""Compare the schema of a config file with its model."""

import json

from jsonschema import Draft202012Validator
from pydantic import ValidationError

from vibroimpact_pipeline.cases import with_cases
from vibroimpact_pipeline.config.reading import ConfigError, merged
from vibroimpact_pipeline.config.schema import schema

MODELS = {"condition", "value_error", "finite_number"}
"""Types of errors that only the model detects."""


def check_of(model) -> Draft202012Validator:
    return Draft202012Validator(json.loads(schema(model)))


def refused_by_both(model, configs, of_file) -> int:
    """Return the number of configs with an invalid value for the model; check that the schema refuses them all.

    Conditions across values, and limits of numbers that are given as text, are left out, since only the model checks
    them. of_file: function that returns the part of a whole config that belongs to the file.
    """
    refused, check = 0, check_of(model)
    for config in configs:
        try:
            whole = merged([("config", config)])
            cases = whole["cases"] if isinstance(whole.get("cases"), dict) else ()
            values = of_file(whole)
            model.model_validate(of_file(with_cases(whole)), context=[*cases])
        except ConfigError:
            continue  # the config contains values that no config can have
        except ValidationError as error:
            errors = [one for one in error.errors() if one["loc"][-1:] != ("case",)]  # a missing case has a default
            if any(one["type"] not in MODELS and not isinstance(one["input"], str) for one in errors):
                assert not check.is_valid(values), values
                refused += 1
    return refused
