"""Bad configs, one per row, each with the line that the user reads."""

import copy

import pytest
import yaml

from pipeline_trees import ROOT
from vibroimpact_pipeline.config import case_parameters, complaints, parse, problems, typed

GOOD = parse((ROOT / "config/config.yaml").read_text())
SCHEMA = yaml.safe_load((ROOT / "workflow/schemas/config.schema.yaml").read_text())
REST = [0.0] * 8


def changed(path, value):
    """A copy of the good config with one value set (or, for ..., deleted)."""
    config = copy.deepcopy(GOOD)
    *parents, key = path.split(".")
    place = config
    for parent in parents:
        place = place[parent]
    if value is ...:
        del place[key]
    else:
        place[key] = value
    return config


def test_the_config_of_the_chapter_is_valid():
    assert problems(GOOD, SCHEMA) == []


@pytest.mark.parametrize(
    ("path", "value", "message"),
    [
        ("system.kappa", 1.2, "system.kappa: 1.2 is not below 1"),
        ("system.kappa", 0, "system.kappa: 0 is not above 0"),
        ("system.kappa", ..., "system.kappa: missing"),
        ("system.kappa", "high", "system.kappa: 'high' is not a number"),
        ("system.kappa", "6e-1", "system.kappa: '6e-1' is not a number (write 0.6)"),
        ("system.kappa", True, "system.kappa: True is not a number"),
        ("system.kappa", None, "system.kappa: nothing is not a number"),
        ("system.epsilon", -0.1, "system.epsilon: -0.1 is not above 0"),
        ("system.epsilon", float("nan"), "system.epsilon: nan is not finite"),
        ("system.sigma_e_hat", float("inf"), "system.sigma_e_hat: inf is not finite"),
        ("system.gamma1_hat", -0.2, "system.gamma1_hat: -0.2 is below 0"),
        ("system.gamma12_hat", -1, "system.gamma12_hat: -1 is below 0"),
        ("system.alpha12_hat", -1.0, "system.alpha12_hat: -1.0 is below 0"),
        ("system.sigma20_hat", -10.0, "system.sigma20_hat: 1 + epsilon sigma20_hat = 0.0 is not above 0"),
        ("system.sigma_e_hat", -20.0, "system.sigma_e_hat: 1 + epsilon sigma_e_hat = -1.0 is not above 0"),
        ("system", [0.1], "system: [0.1] is not a mapping"),
        ("system.kapa", 0.65, "system.kapa: unknown key, did you mean 'kappa'?"),
        ("system.colour", "red", "system.colour: unknown key"),
        ("caes", {}, "caes: unknown key, did you mean 'cases'?"),
        ("cases", {}, "cases: is empty"),
        ("cases.Strong", GOOD["cases"]["equal"], "cases: 'Strong' does not match ^[a-z][a-z0-9_]+$"),
        ("cases.equal.f10_hat", "1", "cases.equal.f10_hat: '1' is not a number (write 1.0)"),
        ("cases.equal.f20_hat", ..., "cases.equal.f20_hat: missing"),
        ("cases.weak.simulation.window_cycles", 0, "cases.weak.simulation.window_cycles: 0 is below 1"),
        ("cases.weak.simulation.window_cycles", 2.5, "cases.weak.simulation.window_cycles: 2.5 is not a whole number"),
        ("cases.weak.simulation.transient_cycles", -1, "cases.weak.simulation.transient_cycles: -1 is below 0"),
        (
            "cases.weak.simulation.transient_cycles",
            10**7,
            "cases.weak.simulation.transient_cycles: 10000000 is above 1000000",
        ),
        (
            "cases.weak.simulation.initial_state",
            REST[:7],
            "cases.weak.simulation.initial_state: has 7 entries, not 8",
        ),
        (
            "cases.weak.simulation.initial_state",
            [*REST[:7], "x"],
            "cases.weak.simulation.initial_state[7]: 'x' is not a number",
        ),
        (
            "cases.weak.simulation.initial_state",
            [0.0, 0.0, 0.5, -0.75, 0.0, 0.0, 0.0, 0.0],
            "cases.weak.simulation.initial_state: ball 2 starts beyond a wall: X2 - Y2 = 1.25 is not between -1 and 1",
        ),
        ("figures.fig10_06.case", "equl", "figures.fig10_06.case: unknown case 'equl', did you mean 'equal'?"),
        ("figures.fig10_06.notebook", "drawings", "figures.fig10_06.notebook: 'drawings' is not 'fixed_points'"),
        ("figures.fig10_06.C_max", [4.0, 0.5], "figures.fig10_06.C_max[1]: 0.5 is not above 1"),
        ("figures.fig10_07.fixed_point", "C", "figures.fig10_07.fixed_point: 'C' does not match ^[a-z]$"),
        ("figures.fig10_05.C_range", [0.9, 1.1], "figures.fig10_05.C_range[0]: 0.9 is above 0.6"),
        ("figures.fig10_03.tau0_max", 1.0, "figures.fig10_03.tau0_max: 1.0 is below 3.15"),
        ("figures.fig10_12", {}, "figures.fig10_12: unknown key, did you mean 'fig10_11'?"),
    ],
)
def test_a_bad_value_is_reported_in_one_line(path, value, message):
    found = problems(changed(path, value), SCHEMA)
    assert [f"{place}: {what}" for place, what in found] == [message]


def test_a_misspelt_key_is_one_problem_not_two():
    config = changed("system.kappa", ...)
    config["system"]["kapa"] = 0.65
    assert problems(config, SCHEMA) == [("system.kapa", "unknown key, did you mean 'kappa'?")]


def test_every_problem_is_reported_at_once():
    config = changed("system.kappa", 1.2)
    config["cases"]["weak"]["f10_hat"] = None
    assert problems(config, SCHEMA) == [
        ("cases.weak.f10_hat", "nothing is not a number"),
        ("system.kappa", "1.2 is not below 1"),
    ]


def test_an_undamped_system_driven_at_its_resonance_is_refused():
    config = copy.deepcopy(GOOD)
    config["system"] |= {"gamma1_hat": 0, "gamma2_hat": 0, "gamma12_hat": 0, "sigma20_hat": 0, "sigma_e_hat": 0}
    [(path, what)] = problems(config, SCHEMA)
    assert path == "system.sigma_e_hat"
    assert "resonance" in what
    config["system"]["sigma_e_hat"] = 0.2
    assert problems(config, SCHEMA) == []


@pytest.mark.parametrize(
    ("parameters", "path"),
    [
        ({"sigma_e_hat": 0, "sigma20_hat": 0, "alpha12_hat": 0}, "system.sigma_e_hat"),
        ({"sigma20_hat": (3 * 1.02) ** 2 * 10 - 10, "alpha12_hat": 0}, "cases.weak.system"),
    ],
)
def test_an_undamped_system_without_isolated_responses_is_refused(parameters, path):
    """At a resonance that no force loads, and at one with the third harmonic of the impacts."""
    config = copy.deepcopy(GOOD)
    config["system"] |= {"gamma1_hat": 0, "gamma2_hat": 0, "gamma12_hat": 0} | parameters
    unforced = {"f10_hat": 0.0, "f20_hat": 0.0} if path == "system.sigma_e_hat" else {}
    config["cases"] = {"weak": config["cases"]["weak"] | unforced}
    found = [(place, what) for place, what in problems(config, SCHEMA) if "unknown case" not in what]
    assert [place for place, _ in found] == [path]
    assert "resonance" in found[0][1]


def test_no_force_and_an_unforced_uncoupled_module_are_right():
    config = copy.deepcopy(GOOD)
    config["cases"]["weak"] |= {"f10_hat": 0.0, "f20_hat": 0.0}
    assert problems(config, SCHEMA) == []
    config["system"] |= {"alpha12_hat": 0, "gamma12_hat": 0}
    config["cases"]["weak"] |= {"f10_hat": 1.0}
    assert problems(config, SCHEMA) == []


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("system:\n  kappa: 0.65\n  kappa: 0.7\n", "line 3, column 3: key 'kappa' given twice"),
        ("system: [1, 2\ncases: 3\n", "line 2, column 6: expected ',' or ']', but got ':'"),
        ("system:\n\tkappa: 1\n", "line 2, column 1: found character '\\t' that cannot start any token"),
        ("- 1\n", "[1] is not a mapping of system, cases and figures"),
        ("", "nothing is not a mapping of system, cases and figures"),
    ],
)
def test_text_that_is_no_config_is_refused_with_its_place(text, message):
    with pytest.raises(ValueError, match=r".") as refusal:
        parse(text)
    assert str(refusal.value) == message


def test_a_complaint_names_the_place_to_mend():
    found = [("system.kappa", "wrong"), ("cases.weak.simulation.initial_state[3]", "wrong")]
    found.append(("system.epsilon", "missing"))
    start = {"cases": {"weak": {"simulation": {"initial_state": REST}}}}
    origins = {"config/config.yaml": start, "try.yaml": {"system": {"kappa": 2}} | start, "--config": start}
    assert complaints(found, origins) == [
        "try.yaml: system.kappa: wrong",
        "--config: cases.weak.simulation.initial_state[3]: wrong",
        "config/config.yaml: system.epsilon: missing",
    ]


def test_a_case_has_the_shared_parameters_and_its_own_amplitudes():
    parameters = case_parameters(GOOD, "unequal")
    assert parameters["f20_hat"] == 0.89
    assert parameters["kappa"] == 0.65
    assert len(parameters) == 10


def test_overrides_get_their_types_from_their_text():
    given = {"system": {"kappa": "0.6"}, "cases": {"weak": {"simulation": {"initial_state": ["0", "0.5"]}}}}
    assert typed(given) == {"system": {"kappa": 0.6}, "cases": {"weak": {"simulation": {"initial_state": [0, 0.5]}}}}
    assert typed({"figures": {"fig10_06": {"case": "equal"}}}) == {"figures": {"fig10_06": {"case": "equal"}}}
