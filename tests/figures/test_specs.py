"""SPECs of figures are literals that need no library, and rules pass what notebooks and figures need."""

import papermill
import pytest

from configs import GOOD
from loaded_rules import SPECS, drawn, made, rules, without
from pipeline_trees import ROOT
from vibroimpact_pipeline.html.figure_texts import words
from vibroimpact_pipeline.specs import spec_of

DRAWN = drawn("figures")
OWN = {"like": "fig10_07", "case": "weak", "fixed_point": "a", "periods": 1}
PAGES = {notebook: [one for one in GOOD["figures"] if SPECS[one]["notebook"] == notebook]
    for notebook in sorted({SPECS[one]["notebook"] for one in GOOD["figures"]})}  # fmt: skip


@pytest.fixture(scope="module")
def of_the_chapter(tmp_path_factory):
    """Return the rules of the workflow."""
    return rules(tmp_path_factory.mktemp("chapter"))


@pytest.mark.parametrize("notebook", PAGES)
def test_rules_set_all_parameters_of_a_notebook(notebook, of_the_chapter):
    """Parameters that only other figures of the notebook need have the default None."""
    known = papermill.inspect_notebook(str(ROOT / f"notebooks/{notebook}.ipynb"))
    passed = {}
    for figure, page in of_the_chapter[f"pages_{notebook}"].params.pages.items():
        system = {"case": page["case"], **page["system"]} if page["case"] else {}
        settings = {path.rpartition(".")[2] for path in page["config"]} - {page["case"]}
        passed[figure] = {"figure", "alt", "inputs", *system, *settings}
    assert [*passed] == PAGES[notebook]
    assert set().union(*passed.values()) == known.keys()
    if notebook != "closed_form":
        for names in passed.values():
            assert {known[name]["default"] for name in known.keys() - names} <= {"None"}


def test_the_figures_of_the_config_are_those_of_the_reference_set(of_the_chapter):
    assert sorted(made(of_the_chapter, "figure_check")) == DRAWN
    for figure in DRAWN:
        folder = "figures" if figure.startswith("fig10_") else "accuracy"
        assert of_the_chapter[figure].output.png == f"results/{folder}/{figure}.png"


@pytest.mark.parametrize(
    ("lacking", "gone"), [(("figures", "fig10_06"), {"fig10_06"}), (("cases", "weak"), {"fig10_10", "fig10_11"})]
)
def test_a_figure_without_settings_in_the_config_is_not_drawn(lacking, gone, tmp_path):
    assert set(DRAWN) - made(rules(tmp_path, without(*lacking)), "figure_check") == gone


def test_captions_and_files_of_a_user_s_figure_are_its_own_and_captions_name_another_model():
    planes, own = (spec_of("mine", OWN | {"like": like, "C_max": 2.0}, SPECS) for like in ("fig10_10", "fig10_07"))
    assert [one["module"].rpartition(".")[2] for one in (planes, own)] == ["fig10_10", "fig10_07"]
    assert planes["tables"]["csv"]["file"] == "results/figures/mine.csv"
    assert planes["caption"] == SPECS["fig10_07"]["own"]["caption"]
    scene, parameters = GOOD["figures"]["fig10_07"], GOOD["system"] | {"f10_hat": 1.0, "f20_hat": 1.0}
    plain, exact = (words("fig10_07", scene | {"model": model}, parameters) for model in ("slow_flow", "exact_orbit"))
    assert exact["caption"] == f"{plain['caption']} Drawn with the model *exact orbit*."


def test_the_record_of_a_figure_names_its_settings_by_their_place_in_the_config(of_the_chapter):
    params, run = of_the_chapter["fig10_11"].params, GOOD["cases"]["weak"]["simulation"]
    assert of_the_chapter["fig10_11"].input.samples == "results/simulations/weak/reference/samples.csv"
    assert params.settings == {}
    assert params.config["figures.fig10_11.model"] == "reference"
    assert params.config["cases.weak.simulation.transient_cycles"] == run["transient_cycles"]
    assert params.config["cases.weak"] == params.system
