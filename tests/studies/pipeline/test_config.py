"""Test the config of the studies: errors name the invalid keys, and systems can be built from accepted values."""

import pytest
from hypothesis import given, settings

from configs import GOOD, problems, with_another_number
from loaded_rules import rules
from studies.configs import TABLE, UNUSUAL, edited
from vibroimpact.studies.sweeps.grid import Grid, axis
from vibroimpact.system import System
from vibroimpact_pipeline.config import checked
from vibroimpact_pipeline.config.model import PREFIXES, RULES
from vibroimpact_pipeline.specs import case_parameters


@pytest.mark.parametrize(("edits", "keys"), TABLE, ids=[edits[:60] for edits, _ in TABLE])
def test_errors_of_a_malformed_config_name_its_invalid_keys(edits, keys):
    assert ", ".join(problems(edited(edits))) == keys


@pytest.mark.parametrize("edits", UNUSUAL)
def test_an_unusual_config_is_accepted(edits):
    assert problems(edited(edits)) == {}


@given(with_another_number("system", "cases", "sweeps"))
@settings(max_examples=100)
def test_sweeps_can_be_built_from_any_accepted_config(config):
    if problems(config):
        return
    validated = checked(config)
    systems = {case: System(**case_parameters(validated, case)) for case in validated["cases"]}
    for sweep in validated["sweeps"].values():
        axes = [axis(**entry) for entry in [*sweep["axes"], *([sweep["band"]] if "band" in sweep else [])]]
        if all(len(set(entry.values)) == len(entry.values) for entry in axes) and len(axes) < 3:
            grid = Grid(systems[sweep["case"]], axes)
            assert all(isinstance(grid.system(number), System) for number in range(0, len(grid), 1 + len(grid) // 20))


def test_figures_cannot_have_the_name_of_a_rule(tmp_path):
    entries = {*GOOD["figures"], *GOOD["machines"]}
    found = set(rules(tmp_path))
    assert entries < found
    assert {rule for rule in found - entries if not rule.startswith(PREFIXES)} <= RULES
