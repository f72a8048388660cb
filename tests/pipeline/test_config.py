"""Test which configs are accepted, which keys the errors of other configs name, and that accepted values are usable."""

import copy
import keyword
import re
import subprocess
import sys
import time

import pytest
import yaml
from hypothesis import given, settings
from hypothesis import strategies as st

from configs import GOOD, TABLE, TEXT, UNDAMPED, UNFORCED, UNUSUAL, at, edited, places, problems, with_another_number
from vibroimpact.system import System
from vibroimpact_pipeline.config import ConfigError, checked, merged, read
from vibroimpact_pipeline.config.model import RULES, Config
from vibroimpact_pipeline.jobs import with_key
from vibroimpact_pipeline.specs import case_parameters

ONE_CASE = "cases = {weak: {f10_hat: 0.5, f20_hat: 0.5, simulation: {initial_state: [0, 0, 0, 0, 0, 0, 0, 0], "
ONE_CASE += "transient_cycles: 0, window_cycles: 60, samples_per_cycle: 8}}}"
UNCOUPLED = f"{UNDAMPED} & system.sigma_e_hat = 0 & system.sigma20_hat = 0 & system.alpha12_hat = 0"
THIRD = f"system.sigma20_hat = {(3 * 1.02) ** 2 * 10 - 10}"
"""Edit that makes box 2 resonate at three times the forcing frequency."""


def test_validation_keeps_the_values_of_the_config_files():
    before, validated = copy.deepcopy(GOOD), checked(GOOD)
    assert {section: validated[section] for section in GOOD} == GOOD == before


@pytest.mark.parametrize(("edits", "keys"), TABLE, ids=[edits[:60] for edits, _ in TABLE])
def test_errors_of_a_malformed_config_name_its_invalid_keys(edits, keys):
    assert ", ".join(problems(edited(edits))) == keys


@pytest.mark.parametrize("edits", UNUSUAL)
def test_an_unusual_config_is_accepted(edits):
    assert problems(edited(edits)) == {}


@pytest.mark.parametrize(
    ("edits", "key"),
    [
        (f"{UNCOUPLED} & {UNFORCED}", "system.sigma_e_hat"),
        (f"{UNDAMPED} & system.alpha12_hat = 0 & {THIRD}", "cases.weak"),
    ],
)
def test_an_undamped_system_without_isolated_responses_is_refused(edits, key):
    """No force excites the resonance of the first system; the third harmonic of impacts excites that of the second."""
    errors = problems(edited(f"{ONE_CASE} & {edits}"))
    assert [name for name, message in errors.items() if "unknown" not in message] == [key]
    assert "resonance" in errors[key]


def combined(*texts: str) -> dict:
    """Return the config after merging further files, which are given as YAML."""
    sources = [("config.yaml", GOOD), *((f"{n}.yaml", yaml.safe_load(text)) for n, text in enumerate(texts, 1))]
    return checked(merged(sources), sources)


@pytest.mark.parametrize("null", ["null", "'null'"])
def test_null_removes_an_entry_of_an_earlier_source(null):
    before = copy.deepcopy(GOOD)
    removed = f"figures: {{fig10_10: {null}}}\ncases: {{weak: {{simulation: {{digits: {null}}}, kappa: 0.7}}}}"
    assert combined(removed, f"cases: {{weak: {{kappa: {null}}}}}") == checked(
        edited("figures.fig10_10 = ... & cases.weak.simulation.digits = ...")
    )
    assert before == GOOD


@pytest.mark.parametrize(
    ("text", "key"),
    [
        ("cases: {weak: {f20_hat: 0,4}}", "cases.weak.4: .*; use a point as decimal separator"),
        ("system: {gamma1_hat: 1,2}", "system.2: .*; use a point as decimal separator"),
        ("figures: {fig10_010: }", "figures.fig10_010: .*, did you mean 'fig10_10'\\?"),
        ("figures: {fig10_11: null}", "figures.fig10_11: null removes an entry of an earlier source, but none defines"),
        ("cases:", None),
        ("system: {kappa: null}", "system.kappa: missing"),
    ],
)  # fmt: skip
def test_null_cannot_remove_a_missing_or_required_entry(text, key):
    """The error names file and key. In YAML, `0,4` in braces is the value 0 and the key 4 with a null."""
    with pytest.raises(ConfigError, match=rf"\A(2.yaml|config.yaml): {key or 'cases'}") as refusal:
        combined("figures: {fig10_11: null}", text)
    assert "\n" not in str(refusal.value) or key is None


def test_a_misspelt_key_or_case_is_one_error_with_a_suggestion():
    assert problems(edited("system.kappa = ... & system.kapa = 1")) == {
        "system.kapa": "unknown key, did you mean 'kappa'?"
    }
    assert "a space after the colon" in problems(edited("system.kappa:0 = 1"))["system.kappa:0"]
    assert problems(edited("cases.weak.f2_hat = 1"))["cases.weak.f2_hat"].endswith("did you mean 'f20_hat'?")
    assert problems(edited("system.f10_hat = 1"))["system.f10_hat"] == "unknown key"
    assert problems(edited("figures.fig10_06.case = equl"))["figures.fig10_06.case"].endswith("did you mean 'equal'?")


def test_an_error_names_the_source_of_the_value(tmp_path):
    base, other = tmp_path / "config.yaml", tmp_path / "try.yaml"
    base.write_text(TEXT.replace("    f20_hat: 0.89\n", "    f20_hat: x\n").replace("  gamma1_hat: 0.2\n", ""))
    other.write_text("system: {kappa: 2, epsilon: 0.1}\n")
    config = edited("system.gamma1_hat = ... & cases.unequal.f20_hat = x & system.kappa = 2 & system.epsilon = 99")
    with pytest.raises(ConfigError) as refusal:
        checked(config, [*((path, read(path)) for path in (base, other)), ("--config", {"system": {"epsilon": 99}})])
    assert [line.rsplit(": ", 1)[0] for line in str(refusal.value).splitlines()] == [
        f"{base}: cases.unequal.f20_hat",
        "--config: system.epsilon",
        f"{base}: system.gamma1_hat",
        f"{other}: system.kappa",
    ]


def test_an_error_about_an_argument_names_the_key_of_the_argument():
    arguments = {"figures.mine": {"fixed_point": "d"}, "regimes.epsilon.mixed": {"label": "z"}, "system.kappa": 0.65}
    assert with_key(ValueError("fixed_point: no"), arguments) == "figures.mine.fixed_point: no"
    assert with_key("mixed.label: no", arguments) == "regimes.epsilon.mixed.label: no"
    assert with_key("something: no", arguments) is None


@pytest.mark.parametrize("place", ["system", "cases", "figures"])
@pytest.mark.parametrize("entry", [1, {}])
def test_thousands_of_errors_are_found_within_a_second(place, entry):
    config = copy.deepcopy(GOOD)
    config[place] |= {f"k{number}": entry for number in range(5000)}
    started = time.process_time()
    assert problems(config)
    assert time.process_time() - started < 1


@pytest.mark.parametrize("section", ["cases", "figures"])
def test_python_keywords_and_names_of_attributes_are_valid_names(section):
    candidates = {*dir(Config), *Config.model_fields, *keyword.kwlist}
    names = {name for name in candidates if re.fullmatch("[a-z][a-z_]+", name)}
    assert {"copy", "model_dump", "class", "conditions"} <= names
    for name in names - RULES:
        entry = copy.deepcopy(GOOD[section][{"cases": "weak", "figures": "fig10_08"}[section]])
        own = {"figures": {"like": "fig10_08"}}.get(section, {})
        assert problems(GOOD | {section: GOOD[section] | {name: entry | own}}) == {}


def test_importing_the_model_loads_no_large_packages():
    code = "import sys, vibroimpact_pipeline.config.model; print(*sys.modules)"
    loaded = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True).stdout.split()
    assert not {"scipy", "matplotlib", "numba", "pandas", "snakemake"} & set(loaded)


PLACES = list(places(GOOD))[1:]
WORDS = ["equal", "weak", "a", "z", "kappa", "f20_hat", "simulation", "1e-3", "nan", "inf", "all", 1, 2.5]
NUMBERS = st.integers(-(10**400), 10**400) | st.floats()
SCALARS = st.none() | st.booleans() | NUMBERS | st.text(max_size=8) | st.sampled_from(WORDS)
KEYS = st.one_of(st.text(max_size=8), st.sampled_from(["case", "epsilon", "range", "fig10_06", "notebook"]))
NESTED = st.recursive(SCALARS, lambda inner: st.lists(inner, max_size=8) | st.dictionaries(KEYS, inner, max_size=4))
VALUES = NESTED | st.sampled_from(PLACES).map(lambda place: copy.deepcopy(at(GOOD, place)))


@given(st.lists(st.tuples(st.sampled_from(PLACES), KEYS | st.none(), VALUES), min_size=1, max_size=4))
@settings(max_examples=200)
def test_a_config_with_any_changes_is_accepted_or_refused_with_errors_of_one_line(changes):
    config = copy.deepcopy(GOOD)
    for (*above, last), key, value in changes:
        try:
            inside = at(config, above)
            inside[last if key is None or isinstance(inside, list) else key] = value
        except (LookupError, TypeError):
            continue  # an entry above has been removed already
    problems(config)


@given(with_another_number(*GOOD))
@settings(max_examples=300)
def test_systems_can_be_built_from_any_accepted_config(config):
    if problems(config):
        return
    validated = checked(config)
    for case in validated["cases"]:
        System(**case_parameters(validated, case))
