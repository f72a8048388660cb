"""Rules of the studies' figures: parameters of the notebook, the set of figures, and figures without settings."""

import papermill
import pytest

from loaded_rules import drawn, made, rules, without
from pipeline_trees import ROOT

REFERENCE = "figures/studies"
DRAWN = drawn(REFERENCE)


@pytest.fixture(scope="module")
def of_the_studies(tmp_path_factory):
    """Return the rules of the workflow with the studies."""
    return rules(tmp_path_factory.mktemp("studies"))


def test_the_parameters_of_the_notebook_are_those_that_its_rule_gives(of_the_studies):
    known = papermill.inspect_notebook(str(ROOT / "notebooks/studies/physical_units.ipynb"))
    settings = dict(of_the_studies["machines"].params.settings)
    assert known.keys() == {"figure", "alt", "inputs", *settings.pop("plant"), *settings}


def test_the_config_makes_the_reference_set(of_the_studies):
    assert sorted(made(of_the_studies, "companions")) == sorted([*DRAWN, "nudge"])
    assert all(of_the_studies[figure].output.png == f"results/figures/{figure}.png" for figure in DRAWN)


@pytest.mark.parametrize(
    ("lacking", "gone"),
    [
        (("sweeps", "design"), {"companion_absorber"}),
        (("sweeps", "regime_map"), {"companion_regime_map"}),
        (("figures", "fig10_06"), {"nudge"}),
        (("figures", "fig10_08"), {"companion_10_08"}),
        (("cases", "weak"), {"companion_horizon"}),
        (("cases", "weak", "simulation", "digits"), {"companion_horizon"}),
    ],
)
def test_a_figure_whose_settings_the_config_lacks_is_not_made(lacking, gone, tmp_path):
    assert {*DRAWN, "nudge"} - made(rules(tmp_path, without(*lacking)), "companions") == gone
