"""The config of the studies: what is refused, at which key; and whatever is accepted can be built."""

import pytest
from hypothesis import given, settings

from configs import GOOD, problems, with_another_number
from loaded_rules import rules
from studies.configs import TABLE, UNUSUAL, edited
from vibroimpact.studies.sweeps.grid import Grid, axis
from vibroimpact.system import System
from vibroimpact_pipeline.config import ConfigError, checked, merged
from vibroimpact_pipeline.config.model import PREFIXES, RULES
from vibroimpact_pipeline.specs import case_parameters


@pytest.mark.parametrize(("edits", "keys"), TABLE, ids=[edits[:60] for edits, _ in TABLE])
def test_a_malformed_config_is_refused_at_its_key(edits, keys):
    assert ", ".join(problems(edited(edits))) == keys


@pytest.mark.parametrize("edits", UNUSUAL)
def test_an_unusual_config_is_accepted(edits):
    assert problems(edited(edits)) == {}


def test_a_null_removes_an_entry_of_the_studies():
    nulls = {"regimes": {"epsilon": {"mixed": None}}, "sweeps": {"design": None}}
    made = checked(merged([("config", GOOD), ("--config", nulls)]))
    assert made == checked(edited("regimes.epsilon.mixed = ... & sweeps.design = ..."))
    with pytest.raises(ConfigError, match=r"sweeps.regime_mapp: .*, did you mean 'regime_map'\?"):
        merged([("config", GOOD), ("--config", {"sweeps": {"regime_mapp": None}})])


@given(with_another_number("system", "cases", "sweeps"))
@settings(max_examples=100)
def test_every_number_that_is_accepted_builds_the_sweeps(config):
    if problems(config):
        return
    made = checked(config)
    systems = {case: System(**case_parameters(made, case)) for case in made["cases"]}
    for sweep in made["sweeps"].values():
        axes = [axis(**entry) for entry in [*sweep["axes"], *([sweep["band"]] if "band" in sweep else [])]]
        if all(len(set(entry.values)) == len(entry.values) for entry in axes) and len(axes) < 3:
            grid = Grid(systems[sweep["case"]], axes)
            assert all(isinstance(grid.system(number), System) for number in range(0, len(grid), 1 + len(grid) // 20))


def test_every_rule_of_the_workflow_is_a_name_that_figures_cannot_have(tmp_path):
    own = {*GOOD["figures"], *GOOD["machines"]}
    known = set(rules(tmp_path))
    assert own < known
    assert {rule for rule in known - own if not rule.startswith(PREFIXES)} <= RULES
