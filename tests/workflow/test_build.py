"""Test a whole build: it is complete and recorded, a second build does nothing, and only what changed is rebuilt."""

import json

import pandas as pd
import pytest

from vibroimpact import tables
from vibroimpact_pipeline.result_records import RECORDS

FIGURES = [f"fig10_{number:02}" for number in range(1, 12)]


def test_each_figure_of_the_chapter_has_pictures_numbers_provenance_and_a_page(built):
    results = built / "results"
    for figure in FIGURES:
        kinds = ["png", "pdf", "svg", "provenance.json"] + ["csv"] * (figure not in FIGURES[:2])
        assert all((results / f"figures/{figure}.{kind}").stat().st_size for kind in kinds), figure
        assert (results / f"notebooks/{figure}.html").stat().st_size


def test_a_second_build_does_nothing_and_a_build_without_records_of_snakemake_does_all(rebuilt):
    assert rebuilt.planned() == set()
    (rebuilt / ".snakemake").rename(rebuilt / "aside")
    assert {"fixed_points", "simulation", "fig10_06", "work_precision", "index"} <= rebuilt.planned()


def test_a_build_prints_its_progress_and_the_folder_of_results(rebuilt):
    (rebuilt / "results/figures/fig10_04.png").unlink()
    output = rebuilt.snakemake("fig10_04")
    assert "1 of 1 steps (100%) done" in output
    assert f"Results: {rebuilt / 'results'}/" in output


def test_the_table_of_orbits_has_all_cases_and_proofs_agree_with_its_verdicts(built):
    table = pd.read_csv(built / "results/orbits.csv")
    assert table.groupby("case", sort=False)["symmetric"].sum().to_dict() == {"equal": 4, "unequal": 4, "weak": 2}
    assert table["residual"].max() < 1e-11
    assert ((table["modulus_1"] < 1) == (table["exact"] == "stable")).all()
    assert (table["exact"] == table["floquet_proved"]).all()
    assert ((table["motion_proved"] == "legal") == table["admissible"]).all()


def checksums(tree) -> dict[str, str]:
    """Return the checksum of each result by its path, as recorded by the job that wrote the result."""
    paths = {str(path.relative_to(tree / RECORDS)): path for path in (tree / RECORDS).rglob("*.json")}
    return {name.removesuffix(".json"): json.loads(path.read_text())["sha256"] for name, path in paths.items()}


def test_every_result_has_a_record_and_every_record_a_result(built):
    records = checksums(built).keys()
    assert [path for path in records if not (built / path).exists()] == []
    folders = ("figures", "fixed_points", "orbits", "simulations", "accuracy", "notebooks")
    files = (path for folder in folders for path in (built / "results" / folder).rglob("*") if path.is_file())
    assert {str(path.relative_to(built.path)) for path in files} <= records


def test_a_failed_job_shows_its_log(tree):
    write, error = "    tables.write(", "    raise SystemExit('no such table')\n"
    tree.edit("workflow/scripts/fixed_points.py", write, error + write)
    output = tree.snakemake("results/fixed_points/equal.csv", check=False)
    assert tree.returncode != 0
    assert "no such table" in output
    assert "results/logs/fixed_points/equal.log" in output


FORCE = "f20_hat: 0.89"
EDITS = [
    (FORCE, f"{FORCE}\n    kappa: 0.6", {"fig10_09", "fixed_points"}, {"fig10_06", "fig10_10", "work_precision"}),
    ("C_range: [0.5, 1.1]", "C_range: [0.5, 1.2]", {"fig10_05"}, {"fig10_04", "fixed_points", "simulation"}),
    ("window_cycles: 6", "window_cycles: 7", {"simulation", "fig10_08"}, {"fig10_11", "fixed_points"}),
]
"""Text in the config, text that replaces it, rules that depend on the change, and rules that do not."""


def test_only_rules_that_depend_on_an_edit_or_an_override_are_planned(rebuilt):
    for old, new, dependent, independent in EDITS:
        rebuilt.edit("config/config.yaml", old, new)
        planned = rebuilt.planned()
        assert dependent <= planned, new
        assert not independent & planned, new
        rebuilt.edit("config/config.yaml", new, old)
    planned = rebuilt.planned("figures", "--config", "cases={weak: {f20_hat: 0.4}}")
    assert {"fig10_10", "fig10_11"} <= planned
    assert not {"fig10_06", "fig10_09"} & planned


def test_the_job_of_a_figure_of_a_missing_fixed_point_fails_and_names_the_point(rebuilt):
    rebuilt.edit("config/config.yaml", "fixed_point: c", "fixed_point: d")
    output = rebuilt.snakemake("fig10_07", check=False)
    assert rebuilt.returncode != 0
    assert "fixed_point" in output
    assert "'d'" in output


def test_only_a_figure_that_differs_fails_the_figure_check_which_prints_how_to_accept_it(rebuilt):
    reference = rebuilt / "figures/fig10_04.csv"
    table = tables.read(reference)
    tables.write(table.assign(B=1.01 * table["B"]), reference)
    output = rebuilt.snakemake("figure_check", check=False)
    assert rebuilt.returncode != 0
    verdicts = json.loads((rebuilt / "results/figure_check/figure_check.json").read_text())
    assert {verdict["figure"] for verdict in verdicts} == {*FIGURES, "grazing", "stress_tests", "work_precision"}
    assert {verdict["figure"] for verdict in verdicts if verdict["status"] != "passed"} == {"fig10_04"}
    assert 'To accept intended changes: make accept REASON="why" FIGURES="fig10_04"\n' in output


@pytest.mark.thorough
def test_two_builds_write_the_same_bytes(built, tree):
    """Files that contain run times may differ."""
    tree.snakemake()
    differing = {name for name, _ in checksums(built).items() - checksums(tree).items()}
    assert all("/accuracy/" in name or "provenance" in name or "index.html" in name for name in differing), differing
