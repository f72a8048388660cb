"""What holds of every SPEC: literals that need no library, arguments of `compute`, columns of the published tables."""

import inspect
import subprocess
import sys
from importlib import import_module

import pytest
import yaml

from pipeline_trees import ROOT
from vibroimpact.figures.kit.tables import read
from vibroimpact_pipeline.figure_check.check import kept
from vibroimpact_pipeline.specs import columns, each, made, request, specs

SPECS = specs()
CONFIG = yaml.safe_load((ROOT / "config/config.yaml").read_text(encoding="utf-8"))
DATA = yaml.safe_load((ROOT / "report/data.yaml").read_text(encoding="utf-8"))
COMPUTED = [name for name, spec in SPECS.items() if spec["tables"] and "made_by" not in spec]
PUBLISHED = [(name, file) for name, spec in SPECS.items() if name in COMPUTED for file, _ in kept(name, spec).values()]


def test_they_are_read_where_no_package_is_installed():
    read_alone = "import sys; sys.path.insert(0, 'src'); from vibroimpact_pipeline import specs; print(*specs.specs())"
    done = subprocess.run([sys.executable, "-I", "-S", "-c", read_alone], cwd=ROOT, capture_output=True, text=True)
    assert done.stdout.split() == list(SPECS), done.stderr


@pytest.mark.parametrize("figure", SPECS)
def test_its_words_are_there(figure):
    assert all(SPECS[figure][name].strip() for name in ("title", "caption", "alt", "method"))


@pytest.mark.parametrize("figure", COMPUTED)
def test_compute_takes_what_is_given_and_nothing_else(figure):
    spec = SPECS[figure]
    parameters = inspect.signature(import_module(f"vibroimpact.figures.{figure}").compute).parameters
    given = {*spec.get("settings", {}), *spec.get("inputs", {})} | ({"systems"} if spec.get("systems") else set())
    if "case" in spec and figure != "fig10_08":  # which shows a motion as it is
        given.add("system")
    assert {name for name, entry in parameters.items() if entry.default is entry.empty} <= given <= set(parameters)


@pytest.mark.parametrize(("figure", "file"), PUBLISHED)
def test_every_column_of_a_published_table_is_declared_and_every_declared_one_is_there(figure, file):
    (name,) = (name for name, (kept_as, _) in kept(figure, SPECS[figure]).items() if kept_as == file)
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
        assert not isinstance(kinds, dict) or set(kinds) - {"others"} <= set(table.get("series", table.get("quantity")))


def test_the_config_of_the_chapter_makes_all_figures_but_those_with_a_rule_of_their_own():
    assert set(made(CONFIG, SPECS)) == {name for name, spec in SPECS.items() if "made_by" not in spec}
    assert {path.stem for path in (ROOT / "figures").glob("*.png")} == set(made(CONFIG, SPECS))


@pytest.mark.parametrize(
    ("lacking", "gone"),
    [
        (("sweeps", "design"), {"companion_absorber"}),
        (("sweeps", "regime_map"), {"companion_regime_map"}),
        (("figures", "fig10_08"), {"fig10_08", "companion_10_08"}),
        (("cases", "weak", "simulation", "digits"), {"companion_horizon"}),
    ],
)
def test_a_figure_whose_settings_the_config_lacks_is_not_made(lacking, gone):
    config = yaml.safe_load(yaml.safe_dump(CONFIG))
    section = config
    for key in lacking[:-1]:
        section = section[key]
    del section[lacking[-1]]
    assert set(made(CONFIG, SPECS)) - set(made(config, SPECS)) == gone


def test_a_figure_of_one_s_own_has_the_words_and_files_of_its_own():
    scene = {"notebook": "theoretical_response", "case": "weak", "fixed_point": "a", "periods": 1}
    planes = made(CONFIG | {"figures": {"mine": scene | {"C_max": 2.0}}}, SPECS)["mine"]
    lines = made(CONFIG | {"figures": {"mine": scene}}, SPECS)["mine"]
    assert (planes["module"], lines["module"]) == ("fig10_10", "fig10_07")
    assert planes["tables"]["csv"]["file"] == "results/figures/mine.csv"
    assert planes["caption"] == SPECS["fig10_07"]["own"]["caption"]
    assert lines["request"]["inputs"]["points"] == "results/fixed_points/weak.csv"
    assert lines["request"]["settings"] == {"fixed_point": "a", "periods": 1}


def test_a_request_names_the_places_in_the_config():
    found = request("companion_horizon", SPECS["companion_horizon"], CONFIG)
    assert found["paths"]["state"] == "cases.weak.simulation.initial_state"
    assert found["inputs"] == {"strobe": "results/simulations/weak/strobe.csv"}
    assert found["settings"]["transient_cycles"] == CONFIG["cases"]["weak"]["simulation"]["transient_cycles"]
