"""The target figure_check and the command for provenance, on a real build."""

import json

import pytest

from pipeline_trees import run_module
from vibroimpact_pipeline.provenance.verify import embedded

COMPANIONS = ["10_04", "10_05", "stability", "horizon", "branches", "regime_map", "modulation", "basins", "epsilon"]
FIGURES = [f"fig10_{number:02d}" for number in range(1, 12)] + [f"companion_{name}" for name in COMPANIONS]
CHARTS = ["work_precision", "hazards"]
RECORD = {"figure", "config", "steps", "lock", "inputs", "versions"}
"""What the files of a figure bear."""


def reset_reference(tree, figures=FIGURES):
    """Take the figures of the build as the reference set."""
    for figure in figures:
        for path in (tree / "results/figures").glob(f"{figure}*"):
            if path.suffix in (".png", ".csv") or path.name.endswith(".artists.json"):
                (tree / "figures" / path.name).write_bytes(path.read_bytes())


def test_the_figures_agree_with_the_published_reference(rebuilt):
    output = rebuilt.snakemake("figure_check", check=False)
    assert rebuilt.returncode == 0, output
    assert f"{len(FIGURES)} figures: " in output


def test_a_changed_figure_fails_with_its_reason_and_a_page_to_read(rebuilt):
    reset_reference(rebuilt)
    rebuilt.edit("figures/fig10_04.artists.json", '"unstable"', '"instable"')
    (rebuilt / "figures/fig10_05.csv").unlink()
    basins = rebuilt / "figures/companion_basins.csv"
    basins.write_text(basins.read_text().replace(",strongly modulated,", ",symmetric,"))
    before = {path.name: path.read_bytes() for path in (rebuilt / "figures").iterdir()}
    output = rebuilt.snakemake("figure_check", check=False)
    assert rebuilt.returncode == 1
    assert "\nfig10_04: failed: figure, axes 1, " in output
    assert ": unstable instead of instable" in output
    assert "\nfig10_05: failed: no reference: fig10_05.csv\n" in output
    assert "\ncompanion_basins: failed: companion_basins.csv: label is off by " in output
    assert "\n20 figures: 17 passed, 3 failed; " in output
    assert "fig10_05" in (rebuilt / "results/figure_check/index.html").read_text()
    assert {path.name: path.read_bytes() for path in (rebuilt / "figures").iterdir()} == before


def test_every_figure_of_a_build_has_a_record_in_all_its_files(built):
    figures = {path.with_suffix("") for path in (built / "results").rglob("*.png")}
    assert {path.name for path in figures} == {*FIGURES, *CHARTS}
    for path in figures:
        sidecar = json.loads(path.with_name(f"{path.name}.provenance.json").read_text())
        assert set(sidecar) == RECORD | {"outputs", "commit", "tree", "seconds"}
        assert all(set(step) == {"method", "digits", "files", "modules", "fingerprint"} for step in sidecar["steps"])
        for kind in (".png", ".pdf", ".svg"):
            assert embedded(path.with_suffix(kind)) == {name: sidecar[name] for name in RECORD}
        assert json.loads(path.with_name(f"{path.name}.artists.json").read_text())["axes"]


@pytest.mark.parametrize(
    ("figure", "key"),
    [
        ("companion_branches", "regimes.branches.paths"),
        ("companion_regime_map", "regimes.map"),
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
