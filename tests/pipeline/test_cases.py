"""A case may say any parameter of the system: whatever is computed, written or recorded of it has its own."""

import json
from types import SimpleNamespace

import pandas as pd
import pytest

from chapter import FORCES, PARAMETERS
from configs import GOOD, edited
from pipeline_trees import ROOT
from vibroimpact import System, fixed_points
from vibroimpact.studies.figures import companion_regime_map
from vibroimpact_pipeline.cases import title_of
from vibroimpact_pipeline.chapter import departures
from vibroimpact_pipeline.config import checked
from vibroimpact_pipeline.html.figure_texts import figure_texts
from vibroimpact_pipeline.provenance import differences
from vibroimpact_pipeline.specs import case_parameters
from vibroimpact_pipeline.studies.report.live import live_data

CONFIG = checked(
    edited(
        "cases.soft = {f10_hat: 1, f20_hat: 0.9, kappa: 0.5, epsilon: 0.05, "
        "simulation: {initial_state: [0, 0, 0, 0, 0, 0, 0, 0], transient_cycles: 9, window_cycles: 6, "
        "samples_per_cycle: 8}} & figures.soft_motion = {notebook: simulation, model: float64, case: soft}"
    )
)
SOFT = PARAMETERS | {"f10_hat": 1.0, "f20_hat": 0.9, "kappa": 0.5, "epsilon": 0.05}
SYSTEMS = {case: System(**case_parameters(CONFIG, case)) for case in CONFIG["cases"]}


def test_its_parameters_are_its_own_and_else_those_of_all():
    assert case_parameters(CONFIG, "soft") == SOFT
    for case, forces in FORCES.items():
        assert case_parameters(CONFIG, case) == PARAMETERS | dict(zip(("f10_hat", "f20_hat"), forces, strict=True))


def test_its_words_say_in_what_it_differs():
    assert title_of(CONFIG, "soft") == "soft (epsilon = 0.05, kappa = 0.5)"
    assert title_of(CONFIG, "weak") == "weak"
    assert title_of(checked(edited("cases.weak.title = Faint & cases.weak.kappa = 0.5")), "weak") == "Faint"
    texts = figure_texts(ROOT, CONFIG)
    assert texts["soft_motion"]["title"] == "Simulated motion of case soft (epsilon = 0.05, kappa = 0.5)"


def test_a_case_of_the_chapter_with_a_parameter_of_its_own_is_a_departure():
    changed = checked(edited("cases.weak.kappa = 0.5"))
    assert departures(checked(GOOD)) == departures(CONFIG) == []
    assert departures(changed) == ["cases.weak.kappa is 0.5, not 0.65"]
    title = figure_texts(ROOT, changed)["fig10_11"]["title"]
    assert title.startswith("Figure 10.11 for other parameters. ")


def test_a_record_tells_of_the_parameter(tmp_path):
    others = {"code": {}, "inputs": {}, "files": {}}
    made = {"config": {"cases.weak": case_parameters(checked(GOOD), "weak")}, **others}
    told, *_ = differences(tmp_path / "none", made, checked(edited("cases.weak.kappa = 0.5")))
    assert told.startswith("config, cases.weak: is ")
    assert "'kappa': 0.5" in told


def test_the_live_page_has_the_cases_that_differ_in_forces():
    """Not `soft`, of which the tables of a build have points as well."""
    points = [(case, point.label, "", "no orbit") for case, one in SYSTEMS.items() for point in fixed_points(one)]
    tables = {"fixed_points.csv": pd.DataFrame(points, columns=["case", "label", "orbit", "exact"])}
    tables |= {"orbits.csv": pd.DataFrame(columns=["case", "label", "modulus_1"])}
    data = json.loads(live_data(SimpleNamespace(table=tables.get), CONFIG))
    assert data["system"] == PARAMETERS
    assert {name: tuple(case["forces"]) for name, case in data["cases"].items()} == FORCES


@pytest.mark.parametrize(("base", "marked"), [("equal", set(FORCES)), ("soft", {"soft"})])
def test_a_map_marks_the_cases_that_differ_in_forces(base, marked):
    places = [(f10, f20) for f10 in (0.5, 1.0) for f20 in (0.5, 1.0)]
    counts = dict.fromkeys(companion_regime_map.REGIMES, 0.0) | {"symmetric 1:1": 1.0}
    cells = pd.DataFrame({"f10_hat": f10, "f20_hat": f20, "fixed_points": 1, "stable_points": 1} for f10, f20 in places)
    cells = cells.assign(**counts, **{companion_regime_map.FROM_REST: "symmetric 1:1"})
    tables = companion_regime_map.compute(cells, SYSTEMS[base], SYSTEMS, 2)
    assert set(tables["cases"]["case"]) == marked
