"""The schema that is committed is that of the model, and Snakemake's own check agrees with the model's."""

import copy
import json

import jsonschema
import pytest
from pydantic import ValidationError
from snakemake.exceptions import WorkflowError
from snakemake.utils import validate

from configs import GOOD, TABLE, UNUSUAL, edited, problems
from vibroimpact.system.chapter import CASES
from vibroimpact_pipeline.cases import CHAPTER, with_cases
from vibroimpact_pipeline.config.model import Config
from vibroimpact_pipeline.config.reading import ConfigError, checked, merged
from vibroimpact_pipeline.config.schema import TARGET, schema

CHECK = jsonschema.Draft202012Validator(json.loads(schema()))
MODELS = {"condition", "value_error", "finite_number"}
"""Errors that are found by the model alone."""


def nodes(node):
    yield node
    for item in node.values() if isinstance(node, dict) else node if isinstance(node, list) else ():
        yield from nodes(item)


def test_it_is_up_to_date():
    assert TARGET.read_text(encoding="utf-8") == schema(), "run python -m vibroimpact_pipeline.config.schema"


def test_every_number_has_limits_on_both_sides_and_every_key_a_description():
    found = [node for node in nodes(CHECK.schema) if isinstance(node, dict)]
    numbers = [node for node in found if {"number", "integer"} & set(node.get("type", ()))]
    assert len(numbers) > 80
    for node in numbers:
        assert {"minimum", "exclusiveMinimum"} & node.keys(), node
        assert {"maximum", "exclusiveMaximum"} & node.keys(), node
    keys = [child for node in found for child in node.get("properties", {}).values()]
    lacking = [child for child in keys if isinstance(child, dict) and not described(child)]
    assert not lacking


def described(node) -> bool:
    """Whether a key says what it is, or refers to what does."""
    inner = [node, *node.get("anyOf", [])]
    return any("description" in one or "$ref" in one for one in inner)


def test_snakemake_accepts_the_config_with_it():
    config = copy.deepcopy(GOOD)
    validate(config, str(TARGET))
    assert problems(config) == {}
    with pytest.raises(WorkflowError):
        validate(edited("system.kappa = 1.2"), str(TARGET))


@pytest.mark.parametrize("edits", UNUSUAL)
def test_what_the_model_accepts_the_schema_accepts(edits):
    assert not [error.message for error in CHECK.iter_errors(edited(edits))]


def test_what_is_wrong_with_one_value_the_schema_refuses():
    """Conditions across values are the model's alone, and so are limits of numbers in texts."""
    refused = 0
    for edits, _ in TABLE:
        try:
            values = merged([("config", edited(edits))])
            cases = values["cases"] if isinstance(values.get("cases"), dict) else ()
            Config.model_validate(with_cases(values), context=[*cases])
        except ConfigError:
            continue  # values that no config has
        except ValidationError as error:
            told = [found for found in error.errors() if found["loc"][-1:] != ("case",)]  # which may be the default
            if any(found["type"] not in MODELS and not isinstance(found["input"], str) for found in told):
                assert not CHECK.is_valid(values), edits
                refused += 1
    assert refused > 200


def test_the_cases_of_the_chapter_are_known_without_the_library():
    assert tuple(CASES) == CHAPTER


def test_entries_without_a_case_take_the_default_and_those_of_a_removed_case_are_left_out():
    made = checked(
        edited("cases.equal = ... & default_case = weak & regimes.branches.case = ... & sweeps.design.case = ...")
    )
    assert made["regimes"]["branches"]["case"] == made["sweeps"]["design"]["case"] == "weak"
    assert made["regimes"]["basins"]["case"] == "unequal"
    assert {"fig10_09", "fig10_10"} <= made["figures"].keys()
    assert not {"fig10_06", "fig10_07", "fig10_08"} & made["figures"].keys()
    assert list(made["report"]["animations"]) == ["modulated"]
