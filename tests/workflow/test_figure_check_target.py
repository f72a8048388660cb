"""The target figure_check and the command for provenance, on a real build."""

import json
import shutil

import pytest
import yaml

import figure_check
from pipeline_trees import ROOT, run_module
from vibroimpact.figures.specs import made, specs
from vibroimpact_pipeline.figure_check.check import check
from vibroimpact_pipeline.provenance.verify import embedded

COMPANIONS = ["10_04", "10_05", "stability", "horizon", "branches", "regime_map", "modulation", "basins", "epsilon"]
COMPANIONS += ["asymmetric", "10_08", "10_11", "ladder", "absorber", "response", "decay"]
FIGURES = [f"fig10_{number:02d}" for number in range(1, 12)] + [f"companion_{name}" for name in COMPANIONS]
FIGURES += ["machines"]
CHARTS = ["work_precision", "hazards"]
RECORD = {"figure", "config", "steps", "lock", "inputs", "versions"}
"""What the files of a figure bear."""


CHANGED = ["companion_basins", "fig10_04", "fig10_05"]


@pytest.mark.parametrize("figure", CHANGED)
def test_a_figure_agrees_with_the_published_reference(built, figure):
    """The other figures do in the test below."""
    config = yaml.safe_load((ROOT / "config/config.yaml").read_text(encoding="utf-8"))
    verdict = check(figure, made(config, specs())[figure], ROOT / "figures", built.path)
    assert (verdict["status"], verdict["reasons"]) == ("passed", [])


def test_changed_figures_fail_with_their_reasons_and_a_page_to_read_and_all_others_agree(rebuilt):
    sums = json.loads((rebuilt / "figures/pictures.json").read_text())
    sums["fig10_04"]["svg"] = sums["fig10_05"]["svg"]
    (rebuilt / "figures/pictures.json").write_text(json.dumps(sums))
    (rebuilt / "figures/fig10_05.csv").unlink()
    basins = rebuilt / "figures/companion_basins.csv"
    basins.write_text(basins.read_text().replace(",strongly modulated,", ",symmetric,"))
    before = {path.name: path.read_bytes() for path in (rebuilt / "figures").iterdir()}
    output = rebuilt.snakemake("figure_check", check=False)
    assert rebuilt.returncode == 1
    assert "\nfig10_04: failed: svg: `draw` makes another one of the reference's table" in output
    assert "\nfig10_05: failed: no reference: fig10_05.csv\n" in output
    assert "\ncompanion_basins: failed: companion_basins.csv: label is off by " in output
    assert f"\n{len(FIGURES)} figures: {len(FIGURES) - len(CHANGED)} passed, {len(CHANGED)} failed; " in output
    assert "fig10_05" in (rebuilt / "results/figure_check/index.html").read_text()
    assert {path.name: path.read_bytes() for path in (rebuilt / "figures").iterdir()} == before
    assert "compare_figures" in rebuilt.planned("figure_check"), "an old verdict would be said again"
    assert (rebuilt / "results/figure_check/summary.md").read_text().count(": failed: ") == len(CHANGED)


def test_without_a_reference_set_all_else_is_built_as_ever(rebuilt):
    shutil.rmtree(rebuilt / "figures")
    assert rebuilt.planned() == set()
    assert rebuilt.planned("figure_check") == {"compare_figures", "figure_check"}


@pytest.mark.parametrize("strict", [False, True])
@pytest.mark.parametrize("status", ["passed", "not comparable", "failed"])
def test_the_exit_status_says_whether_a_figure_failed(tmp_path, capsys, status, strict):
    expected = status == "failed" or (strict and status == "not comparable")
    verdict = {"figure": "fig10_01", "status": status, "reasons": [], "tables": []}
    verdict["reasons"] += ["a reason"] * (status == "failed")
    (tmp_path / "verdicts.json").write_text(json.dumps([verdict]))
    assert figure_check.main(tmp_path / "verdicts.json", "page.html", strict) == expected
    said = capsys.readouterr().out
    assert ('make accept REASON="why" FIGURES="fig10_01"' in said) == (status == "failed")
    assert ("PICTURES=1" in said) == (status == "not comparable")


def test_every_figure_of_a_build_has_a_record_in_all_its_files(built):
    figures = {path.with_suffix("") for path in (built / "results").rglob("*.png")}
    assert {path.name for path in figures} == {*FIGURES, *CHARTS}
    for path in figures:
        sidecar = json.loads(path.with_name(f"{path.name}.provenance.json").read_text())
        assert set(sidecar) == RECORD | {"outputs", "commit", "tree", "seconds", "rounded by"}
        assert all(set(step) == {"method", "digits", "files", "modules", "fingerprint"} for step in sidecar["steps"])
        for kind in (".png", ".pdf", ".svg"):
            assert embedded(path.with_suffix(kind)) == {name: sidecar[name] for name in RECORD}


@pytest.mark.parametrize(
    ("figure", "key"),
    [
        ("companion_branches", "regimes.branches.paths"),
        ("companion_regime_map", "sweeps.regime_map.axes"),
        ("companion_modulation", "cases.weak.f20_hat"),
        ("companion_basins", "system.kappa"),
        ("companion_horizon", "cases.weak.simulation"),
        ("fig10_11", "cases.weak.simulation"),
        ("fig10_04", "system.kappa"),
    ],
)
def test_a_record_holds_the_part_of_the_config_that_decides(built, figure, key):
    record = json.loads((built / f"results/figures/{figure}.provenance.json").read_text())
    assert key in record["config"]


def test_every_figure_tells_where_it_comes_from_and_matches_its_tree(built):
    files = ["fig10_01.png", "fig10_06.pdf", "fig10_08.svg", "fig10_10.csv", "companion_basins.png"]
    files += ["companion_horizon.svg", "companion_stability.pdf", "companion_regime_map.csv"]
    files += ["../accuracy/work_precision.png", "../accuracy/hazards.svg"]
    for file in files:
        status, said = run_module(built.path, "vibroimpact_pipeline.provenance.verify", f"results/figures/{file}")
        assert status == 0, said
        assert "The file matches the tree." in said
