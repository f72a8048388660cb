"""Test cases that override parameters of the system: results, titles and records use the values of the case."""

from chapter import FORCES, PARAMETERS
from configs import GOOD, SOFT, edited
from vibroimpact.system import chapter
from vibroimpact_pipeline.cases import title_of
from vibroimpact_pipeline.chapter import departures
from vibroimpact_pipeline.config import checked
from vibroimpact_pipeline.html.figure_texts import figure_texts
from vibroimpact_pipeline.provenance import differences
from vibroimpact_pipeline.specs import case_parameters

CONFIG = checked(edited(f"{SOFT} & figures.soft_motion = {{like: fig10_08, model: float64, case: soft}}"))


def test_a_case_has_its_own_parameters_and_otherwise_those_of_the_system():
    own = {"f10_hat": 1.0, "f20_hat": 0.9, "kappa": 0.5, "epsilon": 0.05}
    assert case_parameters(CONFIG, "soft") == PARAMETERS | own
    assert set(CONFIG["cases"]) == {*FORCES, "soft"}
    for case, forces in FORCES.items():
        assert case_parameters(CONFIG, case) == PARAMETERS | dict(zip(("f10_hat", "f20_hat"), forces, strict=True))


def test_the_library_has_the_values_of_the_chapter():
    assert chapter.PARAMETERS == PARAMETERS
    assert {case: tuple(forces.values()) for case, forces in chapter.CASES.items()} == FORCES


def test_titles_of_a_case_name_its_own_parameters():
    assert title_of(CONFIG, "soft") == "soft (epsilon = 0.05, kappa = 0.5)"
    assert title_of(CONFIG, "weak") == "weak"
    assert title_of(checked(edited("cases.weak.title = Faint & cases.weak.kappa = 0.5")), "weak") == "Faint"
    texts = figure_texts(CONFIG)
    assert texts["soft_motion"]["title"] == "Simulated motion of case soft (epsilon = 0.05, kappa = 0.5)"


def test_a_changed_case_of_the_chapter_is_a_departure_from_the_chapter():
    changed = checked(edited("cases.weak.kappa = 0.5"))
    assert departures(checked(GOOD)) == departures(CONFIG) == []
    assert departures(changed) == ["cases.weak.kappa is 0.5 instead of 0.65"]
    title = figure_texts(changed)["fig10_11"]["title"]
    assert title.startswith("Figure 10.11 for other parameters. ")


def test_a_changed_parameter_of_a_case_is_a_difference_from_the_record(tmp_path):
    others = {"versions": {"python": "2.7"}, "code": {}, "inputs": {}, "files": {}}
    record = {"config": {"cases.weak": case_parameters(checked(GOOD), "weak")}, **others}
    difference, *_ = differences(tmp_path / "none", record, checked(edited("cases.weak.kappa = 0.5")))
    assert difference.startswith("config, cases.weak: was ")
    assert "'kappa': 0.5" in difference
