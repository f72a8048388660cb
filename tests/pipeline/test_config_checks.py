"""Conditions across sections of the config, overrides on the command line, and how problems are told."""

import copy
import re
from dataclasses import fields

import pytest

from configs import GOOD, TEXT, edited
from vibroimpact.system import System
from vibroimpact_pipeline.config import case_parameters, checked, combined, complaints, problems, typed
from vibroimpact_pipeline.config.check import MOST
from vibroimpact_pipeline.config.system import NAMES

REST = [0.0] * 8
UNDAMPED = {"gamma1_hat": 0, "gamma2_hat": 0, "gamma12_hat": 0}


def with_system(parameters):
    """The good config with other parameters and no fixed point asked for by its label."""
    config = edited("figures.fig10_07 = ... & figures.fig10_10 = ... & regimes.epsilon.mixed = ...")
    config["system"] |= parameters
    return config


def test_the_config_of_the_chapter_is_valid():
    assert problems(GOOD) == []


def test_a_misspelt_key_is_one_problem_not_two():
    config = edited("system.kappa = ... & system.kapa = 0.65")
    assert problems(config) == [("system.kapa", "unknown key, did you mean 'kappa'?")]


def test_every_problem_is_reported_at_once():
    assert problems(edited("system.kappa = 1.2 & cases.weak.f10_hat = null")) == [
        ("cases.weak.f10_hat", "nothing is not a number"),
        ("system.kappa", "1.2 is not below 1"),
    ]


def test_an_undamped_system_driven_at_its_resonance_is_refused():
    config = with_system(UNDAMPED | {"sigma20_hat": 0, "sigma_e_hat": 0})
    [(path, what)] = problems(config)
    assert path == "system.sigma_e_hat"
    assert "resonance" in what
    config["system"]["sigma_e_hat"] = 0.2
    assert problems(config) == []


@pytest.mark.parametrize(
    ("parameters", "path"),
    [
        ({"sigma_e_hat": 0, "sigma20_hat": 0, "alpha12_hat": 0}, "system.sigma_e_hat"),
        ({"sigma20_hat": (3 * 1.02) ** 2 * 10 - 10, "alpha12_hat": 0}, "cases.weak"),
    ],
)
def test_an_undamped_system_without_isolated_responses_is_refused(parameters, path):
    """At a resonance that no force loads, and at one with the third harmonic of the impacts."""
    config = with_system(UNDAMPED | parameters)
    unforced = {"f10_hat": 0.0, "f20_hat": 0.0} if path == "system.sigma_e_hat" else {}
    config["cases"] = {"weak": config["cases"]["weak"] | unforced}
    found = [(place, what) for place, what in problems(config) if "unknown case" not in what]
    assert [place for place, _ in found] == [path]
    assert "resonance" in found[0][1]


def test_no_force_and_an_unforced_uncoupled_module_are_right():
    config = with_system({})
    config["cases"]["weak"] |= {"f10_hat": 0.0, "f20_hat": 0.0}
    assert problems(config) == []
    config["system"] |= {"alpha12_hat": 0, "gamma12_hat": 0}
    config["cases"]["weak"] |= {"f10_hat": 1.0}
    assert problems(config) == []


def test_a_path_may_lead_along_every_parameter():
    assert list(NAMES) == [field.name for field in fields(System)]


def test_a_file_is_checked_as_a_whole(tmp_path):
    path = tmp_path / "config.yaml"
    path.write_text(TEXT, encoding="utf-8")
    assert checked(path) == GOOD
    for text, line in [("- 1\n", "[1] is not a mapping of"), (TEXT.replace("0.65", "1.2"), "system.kappa: 1.2 is not")]:
        path.write_text(text, encoding="utf-8")
        with pytest.raises(ValueError, match=re.escape(f"{path}: {line}")):
            checked(path)


def test_a_complaint_names_the_place_to_mend():
    found = [("system.kappa", "wrong"), ("cases.weak.simulation.initial_state[3]", "wrong")]
    found.append(("system.epsilon", "missing"))
    start = {"cases": {"weak": {"simulation": {"initial_state": REST}}}}
    whole = {"system": {"kappa": 0.65}} | start
    origins = {"config/config.yaml": whole, "try.yaml": {"system": {"kappa": 2}} | start, "--config": start}
    assert complaints(found, origins) == [
        "try.yaml: system.kappa: wrong",
        "--config: cases.weak.simulation.initial_state[3]: wrong",
        "config/config.yaml: system.epsilon: missing",
    ]


def test_no_more_complaints_are_shown_than_can_be_read():
    lines = complaints([("system.kappa", "wrong")] * (MOST + 5), {"config/config.yaml": {}})
    assert len(lines) == MOST + 1
    assert lines[-1] == "... and 5 more"


def test_a_case_has_the_shared_parameters_and_its_own_amplitudes():
    parameters = case_parameters(GOOD, "unequal")
    assert parameters["f20_hat"] == 0.89
    assert parameters["kappa"] == 0.65
    assert len(parameters) == 10


def test_checking_leaves_the_config_as_it_is():
    config = copy.deepcopy(GOOD)
    problems(config)
    assert config == GOOD


def test_overrides_get_their_types_from_their_text():
    given = {"system": {"kappa": "0.6"}, "cases": {"weak": {"simulation": {"initial_state": ["0", "0.5"]}}}}
    assert typed(given) == {"system": {"kappa": 0.6}, "cases": {"weak": {"simulation": {"initial_state": [0, 0.5]}}}}
    assert typed({"figures": {"fig10_06": {"case": "equal"}}}) == {"figures": {"fig10_06": {"case": "equal"}}}


@pytest.mark.parametrize(
    ("given", "line"),
    [
        ({"cases": "{weak"}, "cases: expected ',' or '}', but got '<stream end>'"),
        ({"system": {"kappa": "0100"}}, "system.kappa: 0100 means 64 in YAML: write that, or '0100' for the text"),
        ({"regimes": {"basins": ["[1"]}}, "regimes.basins[0]: expected ',' or ']', but got '<stream end>'"),
        ({"system": {"kappa": "[" * 50}}, "system.kappa: nested deeper than 20 levels"),
    ],
)
def test_an_override_that_cannot_be_read_is_refused_with_its_key(given, line):
    with pytest.raises(ValueError, match=r".") as refusal:
        typed(given)
    assert str(refusal.value) == line


def test_null_takes_an_entry_away():
    taken = {"cases": {"weak": None}, "regimes": {"epsilon": {"mixed": None}}, "figures": {"fig10_10": None}}
    there = {"cases": {"weak": {}}, "regimes": {"epsilon": {"mixed": {}}}, "figures": {"fig10_10": {}}}
    left = {"system": 1, "cases": {}, "regimes": {"epsilon": {}}, "figures": {}}
    assert combined([{"system": 1} | there, taken]) == left


def test_null_leaves_out_what_may_be_left_out():
    assert combined([edited("regimes.epsilon.mixed = null")]) == edited("regimes.epsilon.mixed = ...")


@pytest.mark.parametrize(
    ("given", "line"),
    [
        ({"system": {"kappa:0.7": None}}, "system.'kappa:0.7': unknown key, did you mean 'kappa'?; a space belongs"),
        ({"cases": {"week": None}}, "cases.week: nothing is not a mapping"),
        ({"cases": {"weak": {"f20_hat:0.4": None}}}, "cases.weak.'f20_hat:0.4': unknown key, did you mean 'f20_hat'?"),
    ],
)
def test_null_takes_nothing_away_that_is_not_there(given, line):
    """As YAML reads `{kappa:0.7}`; the complaint is about who has said so."""
    [complaint] = complaints(problems(combined([GOOD, given])), {"config/config.yaml": GOOD, "--config": given})
    assert complaint.startswith(f"--config: {line}")


def test_later_origins_override_and_leave_the_rest():
    below = {"a": {"b": 1, "c": [1, 2]}, "d": 2}
    assert combined([below, {"a": {"c": [3]}}, {"d": {"e": 4}}]) == {"a": {"b": 1, "c": [3]}, "d": {"e": 4}}
    assert below == {"a": {"b": 1, "c": [1, 2]}, "d": 2}


def test_a_key_that_nobody_gives_is_missing_where_its_neighbours_are():
    origins = {"config/config.yaml": {"cases": {"equal": {}}}, "--config": {"cases": {"mine": {"f10_hat": 1.0}}}}
    assert complaints([("cases.mine.f20_hat", "missing")], origins) == ["--config: cases.mine.f20_hat: missing"]
    assert complaints([("system.kappa", "missing")], origins) == ["config/config.yaml: system.kappa: missing"]
