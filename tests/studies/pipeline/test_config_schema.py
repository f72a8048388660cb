"""The schema of studies.yaml agrees with its model, and entries without a case get the default case."""

import pytest

from schemas import check_of, refused_by_both
from studies.configs import TABLE, UNUSUAL, edited
from vibroimpact_pipeline.config import checked
from vibroimpact_pipeline.config.model import Config
from vibroimpact_pipeline.studies.config.model import Studies


def of_file(config):
    """Return the sections of studies.yaml, and all keys that no config file has."""
    return {name: section for name, section in config.items() if name not in Config.model_fields}


@pytest.mark.parametrize("edits", UNUSUAL)
def test_the_schema_accepts_what_the_model_accepts(edits):
    assert not [error.message for error in check_of(Studies).iter_errors(of_file(edited(edits)))]


def test_the_schema_rejects_single_invalid_values():
    assert refused_by_both(Studies, [edited(edits) for edits, _ in TABLE], of_file) > 70


def test_entries_without_a_case_get_the_default_case_and_those_of_a_removed_case_are_left_out():
    made = checked(
        edited("cases.equal = ... & default_case = weak & regimes.branches.case = ... & sweeps.design.case = ...")
    )
    assert made["regimes"]["branches"]["case"] == made["sweeps"]["design"]["case"] == "weak"
    assert made["regimes"]["basins"]["case"] == "unequal"
