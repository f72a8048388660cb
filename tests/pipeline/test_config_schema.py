"""Test that the schema of each config file matches its model, and that both refuse the same."""

import re

import pytest

from configs import GOOD, TABLE, UNUSUAL, edited
from pipeline_trees import ROOT
from schemas import check_of, refused_by_both
from vibroimpact_pipeline.config import checked
from vibroimpact_pipeline.config.model import Config
from vibroimpact_pipeline.config.schema import TARGETS, schema


def of_file(config):
    """Return the sections of config.yaml, and all keys that no config file has."""
    return {name: section for name, section in config.items() if name in Config.model_fields or name not in GOOD}


def nodes(node):
    yield node
    for item in node.values() if isinstance(node, dict) else node if isinstance(node, list) else ():
        yield from nodes(item)


@pytest.mark.parametrize("target", TARGETS, ids=lambda target: target.parent.name)
def test_the_schema_of_a_file_is_up_to_date(target):
    assert target.read_text(encoding="utf-8") == schema(TARGETS[target]), "python -m vibroimpact_pipeline.config.schema"


def test_each_file_names_its_schema_for_editors():
    folder = ROOT / "config"
    named = [re.match("# yaml-language-server: [$]schema=(.*)", path.read_text())[1] for path in folder.glob("*.yaml")]
    assert {(folder / name).resolve() for name in named} == {*TARGETS}


@pytest.mark.parametrize("model", TARGETS.values())
def test_every_number_has_limits_on_both_sides_and_every_key_a_description(model):
    found = [node for node in nodes(check_of(model).schema) if isinstance(node, dict)]
    numbers = [node for node in found if {"number", "integer"} & set(node.get("type", ()))]
    assert len(numbers) > 30
    for node in numbers:
        assert {"minimum", "exclusiveMinimum"} & node.keys(), node
        assert {"maximum", "exclusiveMaximum"} & node.keys(), node
    keys = [child for node in found for child in node.get("properties", {}).values()]
    lacking = [child for child in keys if isinstance(child, dict) and not described(child)]
    assert not lacking


def described(node) -> bool:
    """Return True if a key has a description, or refers to a definition with a description."""
    inner = [node, *node.get("anyOf", [])]
    return any("description" in one or "$ref" in one for one in inner)


@pytest.mark.parametrize("edits", UNUSUAL)
def test_the_schema_accepts_what_the_model_accepts(edits):
    assert not [error.message for error in check_of(Config).iter_errors(of_file(edited(edits)))]


def test_the_schema_rejects_single_invalid_values():
    assert refused_by_both(Config, [edited(edits) for edits, _ in TABLE], of_file) > 100


def test_entries_without_a_case_get_the_default_case_and_those_of_a_removed_case_are_left_out():
    made = checked(
        edited("cases.equal = ... & default_case = weak & accuracy.problems.transient.case = ... & "
        "figures.mine = {like: fig10_08, model: float64}")
    )  # fmt: skip
    assert {problem["case"] for problem in made["accuracy"]["problems"].values()} == {"weak"}
    assert made["figures"]["mine"]["case"] == "weak"
    assert {"fig10_09", "fig10_10"} <= made["figures"].keys()
    assert not {"fig10_06", "fig10_07", "fig10_08"} & made["figures"].keys()
