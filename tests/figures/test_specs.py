"""Rules and SPECs of figures: literals that need no library, arguments of `compute`, columns of published tables."""

import inspect
import subprocess
import sys
from importlib import import_module
from pathlib import Path

import papermill
import pytest
import yaml
from snakemake.api import SnakemakeApi
from snakemake.settings.types import ConfigSettings, ResourceSettings

from pipeline_trees import ROOT
from vibroimpact.tables import read
from vibroimpact_pipeline.figure_check.check import compared_files
from vibroimpact_pipeline.html.figure_texts import words
from vibroimpact_pipeline.specs import columns, each, spec_of, specs

SPECS = specs()
CONFIG = yaml.safe_load((ROOT / "config/config.yaml").read_text(encoding="utf-8"))
DATA = yaml.safe_load((ROOT / "report/data.yaml").read_text(encoding="utf-8"))
DRAWN = sorted(path.stem for path in (ROOT / "figures").glob("*.png"))
PUBLISHED = [(name, file) for name in DRAWN for file, _ in compared_files(name, SPECS[name]).values()]
OWN = {"notebook": "theoretical_response", "case": "weak", "fixed_point": "a", "periods": 1}


def rules(folder: Path, config: dict | None = None) -> dict:
    """The rules for a config, by name."""
    given = folder / "config.yaml"
    given.write_text(yaml.safe_dump(config or CONFIG), encoding="utf-8")
    settings = ConfigSettings(configfiles=[given], replace_workflow_config=True)
    with SnakemakeApi() as api:
        workflow = api.workflow(
            resource_settings=ResourceSettings(cores=1),
            config_settings=settings,
            snakefile=ROOT / "Snakefile",
            workdir=folder,
        )
        return {rule.name: rule for rule in workflow._workflow.rules}


@pytest.fixture(scope="module")
def of_the_chapter(tmp_path_factory):
    return rules(tmp_path_factory.mktemp("chapter"))


def test_they_are_read_where_no_package_is_installed():
    read_alone = "import sys; sys.path.insert(0, 'src'); from vibroimpact_pipeline import specs; print(*specs.specs())"
    done = subprocess.run([sys.executable, "-I", "-S", "-c", read_alone], cwd=ROOT, capture_output=True, text=True)
    assert done.stdout.split() == list(SPECS), done.stderr


@pytest.mark.parametrize("figure", SPECS)
def test_its_words_are_there(figure):
    assert all(SPECS[figure][name].strip() for name in ("title", "caption", "alt", "method"))


@pytest.mark.parametrize("figure", [name for name in DRAWN if SPECS[name]["tables"]])
def test_compute_takes_what_its_rule_gives(figure, of_the_chapter):
    rule, compute = of_the_chapter[figure], import_module(f"vibroimpact.figures.{figure}").compute
    arguments = inspect.signature(compute).parameters
    given = {
        *rule.input.keys(),
        *rule.params.settings,
        *(name for name in ("system", "systems") if rule.params.get(name)),
    }
    assert {name for name, entry in arguments.items() if entry.default is entry.empty} <= given
    if not rule.input.get("notebook"):  # which shows more than the figure does
        assert given - {"system"} <= set(arguments)


@pytest.mark.parametrize("notebook", sorted({scene["notebook"] for scene in CONFIG["figures"].values()}))
def test_the_parameters_of_a_notebook_are_those_that_rules_give(notebook, of_the_chapter):
    """All of them, or the rest stays at None or is of another figure of the notebook."""
    known = papermill.inspect_notebook(str(ROOT / f"notebooks/{notebook}.ipynb"))
    given = {}
    for figure in (figure for figure, scene in CONFIG["figures"].items() if scene["notebook"] == notebook):
        params = of_the_chapter[figure].params
        system = {"case": params.case, **params.system} if params.case else {}
        given[figure] = {
            "figure",
            "alt",
            "inputs",
            "outputs",
            *system,
            *params.settings,
            *params.settings.get("plant", {}),
        }
    assert set().union(*given.values()) - {"plant"} == known.keys()
    if notebook != "closed_form":
        for names in given.values():
            assert {known[name]["default"] for name in known.keys() - names} <= {"None"}


@pytest.mark.parametrize(("figure", "file"), PUBLISHED)
def test_every_column_of_a_published_table_is_declared_and_every_declared_one_is_there(figure, file):
    (name,) = (name for name, (kept_as, _) in compared_files(figure, SPECS[figure]).items() if kept_as == file)
    table, declared = read(ROOT / "figures" / file), columns(SPECS[figure]["tables"][name], each(DATA["shared"]))
    assert list(table) == list(declared)
    for column, entry in declared.items():
        assert entry["meaning"]
        assert entry["unit"] in DATA["units"]
        assert not entry.get("values") or set(table[column].dropna()) <= {*entry["values"], ""}
        numbers = column in table.select_dtypes("number")
        assert numbers == (entry["unit"] not in ("text", "true or false")), column
        assert not numbers or "compared" in entry
        kinds = entry.get("compared")
        words = set(table.select_dtypes(exclude="number").iloc[:, :2].to_numpy().ravel())  # that name a series
        assert not isinstance(kinds, dict) or set(kinds) - {"others"} <= words


def made(found):
    """The figures that rules make of the config, with their outputs."""
    return {
        Path(path).stem for rule in ("figures", "companions") for path in found[rule].input if path.endswith(".png")
    }


def test_the_config_of_the_chapter_makes_the_reference_set(of_the_chapter):
    assert sorted(made(of_the_chapter)) == DRAWN
    assert all(of_the_chapter[figure].output.png == f"results/figures/{figure}.png" for figure in DRAWN)


@pytest.mark.parametrize(
    ("lacking", "gone"),
    [
        (("sweeps", "design"), {"companion_absorber"}),
        (("sweeps", "regime_map"), {"companion_regime_map"}),
        (("figures", "fig10_08"), {"fig10_08", "companion_10_08"}),
        (("figures", "fig10_06"), {"fig10_06"}),
        (("cases", "weak"), {"fig10_10", "fig10_11", "companion_horizon"}),
        (("cases", "weak", "simulation", "digits"), {"companion_horizon"}),
    ],
)
def test_a_figure_whose_settings_the_config_lacks_is_not_made(lacking, gone, tmp_path):
    config = yaml.safe_load(yaml.safe_dump(CONFIG))
    section = config
    for key in lacking[:-1]:
        section = section[key]
    del section[lacking[-1]]
    assert set(DRAWN) - made(rules(tmp_path, config)) == gone


def test_a_figure_of_one_s_own_has_the_words_and_files_of_its_own(tmp_path):
    planes = spec_of("mine", OWN | {"C_max": 2.0}, SPECS)
    assert (planes["module"], spec_of("mine", OWN, SPECS)["module"]) == ("fig10_10", "fig10_07")
    assert planes["tables"]["csv"]["file"] == "results/figures/mine.csv"
    assert planes["caption"] == SPECS["fig10_07"]["own"]["caption"]
    rule = rules(tmp_path, CONFIG | {"figures": {"mine": OWN | {"model": "slow_flow"}}})["mine"]
    assert rule.input.points == "results/fixed_points/weak.csv"
    assert rule.output.csv == "results/figures/mine.csv"
    assert rule.params.settings == {"fixed_point": "a", "periods": 1}


def test_a_caption_names_a_model_that_is_not_the_chapter_s():
    scene = CONFIG["figures"]["fig10_07"]
    parameters = CONFIG["system"] | {"f10_hat": 1.0, "f20_hat": 1.0}
    plain, exact = (words("fig10_07", scene | {"model": model}, parameters) for model in ("slow_flow", "exact_orbit"))
    assert exact["caption"] == f"{plain['caption']} Drawn with the model *exact orbit*."


def test_what_decides_on_a_figure_is_named_by_its_place_in_the_config(of_the_chapter):
    params = of_the_chapter["companion_horizon"].params
    run = CONFIG["cases"]["weak"]["simulation"]
    assert of_the_chapter["companion_horizon"].input.strobe == "results/simulations/weak/reference/strobe.csv"
    assert params.settings == {name: run[name] for name in ("initial_state", "transient_cycles")}
    assert params.config["cases.weak.simulation.transient_cycles"] == run["transient_cycles"]
    assert params.config["cases.weak"] == params.system
