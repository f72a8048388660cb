"""The config of the studies: what is refused, at which key; and whatever is accepted can be built."""

import copy
import keyword
import re

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from configs import GOOD, TEXT, problems
from pipeline_trees import CORES, ROOT, run_module
from studies.configs import FILE, TABLE, UNUSUAL, edited
from vibroimpact.studies.sweeps.grid import Grid, axis
from vibroimpact.system import System
from vibroimpact_pipeline.config import ConfigError, checked, merged, read
from vibroimpact_pipeline.config.model import PREFIXES, RULES
from vibroimpact_pipeline.specs import case_parameters
from vibroimpact_pipeline.studies.config.model import Whole


def test_the_config_is_as_it_is_written():
    assert checked(GOOD) == GOOD | {"tile_seconds": 20.0}


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


def test_an_error_names_the_file_that_holds_the_key(tmp_path):
    chapter, studies = tmp_path / "config.yaml", tmp_path / "studies.yaml"
    chapter.write_text(TEXT.replace("kappa: 0.65", "kappa: 1.2"))
    studies.write_text(FILE.read_text(encoding="utf-8").replace("nearness: 0.02", "nearness: 0"))
    sources = [(path, read(path)) for path in (chapter, studies)]
    with pytest.raises(ConfigError) as refusal:
        checked(merged(sources), sources)
    said = [line.rsplit(": ", 1)[0] for line in str(refusal.value).splitlines()]
    assert said == [f"{studies}: regimes.observation.nearness", f"{chapter}: system.kappa"]


def test_a_name_that_means_something_in_python_is_a_name():
    """Names of attributes of the model, keywords and fields of other sections."""
    names = {name for name in [*dir(Whole), *Whole.model_fields, *keyword.kwlist] if re.fullmatch("[a-z][a-z_]+", name)}
    assert {"copy", "model_dump", "class", "conditions"} <= names
    for name in names - RULES:
        assert problems(GOOD | {"sweeps": GOOD["sweeps"] | {name: copy.deepcopy(GOOD["sweeps"]["regime_map"])}}) == {}


def numbers(value, above=()):
    """All places of numbers in a config."""
    items = value.items() if isinstance(value, dict) else enumerate(value) if isinstance(value, list) else ()
    for key, item in items:
        yield from [(*above, key)] if isinstance(item, int | float) else numbers(item, (*above, key))


SWEPT = [place for place in numbers(GOOD) if place[0] in ("system", "cases", "sweeps")]


@given(st.sampled_from(SWEPT), st.sampled_from([-1, 0, 0.5, 1.5, 2, 10, 1e-3, 1e6]) | st.floats(-3, 3))
@settings(max_examples=100)
def test_every_number_that_is_accepted_builds_the_sweeps(place, factor):
    config = copy.deepcopy(GOOD)
    inside = config
    for part in place[:-1]:
        inside = inside[part]
    value = inside[place[-1]] * factor
    inside[place[-1]] = round(value) if isinstance(inside[place[-1]], int) else value
    if problems(config):
        return
    made = checked(config)
    systems = {case: System(**case_parameters(made, case)) for case in made["cases"]}
    for sweep in made["sweeps"].values():
        axes = [axis(**entry) for entry in [*sweep["axes"], *([sweep["band"]] if "band" in sweep else [])]]
        if all(len(set(entry.values)) == len(entry.values) for entry in axes) and len(axes) < 3:
            grid = Grid(systems[sweep["case"]], axes)
            assert all(isinstance(grid.system(number), System) for number in grid.spread(50))


def test_every_rule_of_the_workflow_is_a_name_that_figures_cannot_have():
    _, output = run_module(ROOT, "snakemake", *CORES, "--list-rules", "--quiet", "all")
    rules = {line.strip() for line in output.splitlines() if line.strip().isidentifier()}
    own = {*GOOD["figures"], *GOOD["machines"], *GOOD["report"]["animations"]}
    assert own < rules, output
    assert {rule for rule in rules - own if not rule.startswith(PREFIXES)} <= RULES


def test_the_editor_is_told_of_the_schema():
    name = FILE.read_text(encoding="utf-8").splitlines()[0].removeprefix("# yaml-language-server: $schema=")
    assert (ROOT / "config" / name).resolve() == ROOT / "workflow/schemas/studies/config.schema.json"
