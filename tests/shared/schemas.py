"""The schema of a config file beside its model."""

import json

from jsonschema import Draft202012Validator
from pydantic import ValidationError

from vibroimpact_pipeline.cases import with_cases
from vibroimpact_pipeline.config.reading import ConfigError, merged
from vibroimpact_pipeline.config.schema import schema

MODELS = {"condition", "value_error", "finite_number"}
"""Errors that are found by the model alone."""


def check_of(model) -> Draft202012Validator:
    return Draft202012Validator(json.loads(schema(model)))


def refused_by_both(model, configs, of_file) -> int:
    """Number of configs that a model refuses for one value of its file, all of which its schema refuses.

    Conditions across values are the model's alone, and so are limits of numbers in texts. of_file: function of a whole
    config that returns the part of the file.
    """
    refused, check = 0, check_of(model)
    for config in configs:
        try:
            whole = merged([("config", config)])
            cases = whole["cases"] if isinstance(whole.get("cases"), dict) else ()
            values = of_file(whole)
            model.model_validate(of_file(with_cases(whole)), context=[*cases])
        except ConfigError:
            continue  # values that no config has
        except ValidationError as error:
            told = [found for found in error.errors() if found["loc"][-1:] != ("case",)]  # which may be the default
            if any(found["type"] not in MODELS and not isinstance(found["input"], str) for found in told):
                assert not check.is_valid(values), values
                refused += 1
    return refused
