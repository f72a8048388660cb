"""Test one whole build: it is complete, described and recorded, a second build does nothing, a change is rebuilt."""

import json

import pandas as pd
import pytest

from vibroimpact import tables
from vibroimpact_pipeline.result_records import RECORDS

FIGURES = [f"fig10_{number:02}" for number in range(1, 12)]


def test_every_figure_of_the_chapter_is_there_with_its_page_and_numbers(built):
    results = built / "results"
    for figure in FIGURES:
        kinds = ["png", "pdf", "svg", "provenance.json"] + ["csv"] * (figure not in FIGURES[:2])
        assert all((results / f"figures/{figure}.{kind}").stat().st_size for kind in kinds), figure
        assert (results / f"notebooks/{figure}.html").stat().st_size


def test_a_second_build_has_nothing_to_do_and_one_without_what_snakemake_recorded_has_all(rebuilt):
    assert rebuilt.planned() == set()
    (rebuilt / ".snakemake").rename(rebuilt / "aside")
    assert {"fixed_points", "simulation", "fig10_06", "work_precision", "index"} <= rebuilt.planned()


def test_a_build_says_where_to_look_and_how_far_it_is(rebuilt):
    (rebuilt / "results/figures/fig10_04.png").unlink()
    said = rebuilt.snakemake("fig10_04")
    assert "1 of 1 steps (100%) done" in said
    assert f"Results: {rebuilt / 'results'}/" in said


def test_orbits_of_all_cases_are_gathered(built):
    table = pd.read_csv(built / "results/orbits.csv")
    assert table.groupby("case", sort=False)["symmetric"].sum().to_dict() == {"equal": 4, "unequal": 4, "weak": 2}
    assert table["residual"].max() < 1e-11
    moduli = table.filter(like="modulus_")
    assert moduli.shape[1] == 8
    assert ((moduli["modulus_1"] < 1) == (table["exact"] == "stable")).all()
    assert (table["exact"] == table["floquet_proved"]).all()
    assert ((table["motion_proved"] == "legal") == table["admissible"]).all()
    assert table.filter(like="phase").stack().between(0, 1, inclusive="left").all()


def test_every_result_has_a_record_and_every_record_its_result(built):
    records = {
        str(path.relative_to(built / RECORDS)).removesuffix(".json") for path in (built / RECORDS).rglob("*.json")
    }
    assert [path for path in records if not (built / path).exists()] == []
    folders = ("figures", "fixed_points", "orbits", "simulations", "accuracy", "notebooks")
    files = (path for folder in folders for path in (built / "results" / folder).rglob("*") if path.is_file())
    assert {str(path.relative_to(built.path)) for path in files} <= records


def test_a_failed_job_shows_its_log(tree):
    tree.edit(
        "workflow/scripts/fixed_points.py",
        "    tables.write(",
        "    raise SystemExit('no such table')\n    tables.write(",
    )
    said = tree.snakemake("results/fixed_points/equal.csv", check=False)
    assert tree.returncode != 0
    assert "no such table" in said
    assert "results/logs/fixed_points/equal.log" in said


EDITS = {
    "a parameter of a case": (
        "f20_hat: 0.89",
        "f20_hat: 0.89\n    kappa: 0.6",
        {"fig10_09", "fixed_points"},
        {"fig10_06", "fig10_10", "work_precision"},
    ),
    "one figure": (
        "C_range: [0.5, 1.1]",
        "C_range: [0.5, 1.2]",
        {"fig10_05"},
        {"fig10_04", "fixed_points", "simulation"},
    ),
    "a simulation": ("window_cycles: 6", "window_cycles: 7", {"simulation", "fig10_08"}, {"fig10_11", "fixed_points"}),
}


def test_only_what_depends_on_an_edit_or_an_override_is_planned(rebuilt):
    for edit, (old, new, made, left) in EDITS.items():
        rebuilt.edit("config/config.yaml", old, new)
        planned = rebuilt.planned()
        assert made <= planned, edit
        assert not left & planned, edit
        rebuilt.edit("config/config.yaml", new, old)
    planned = rebuilt.planned("figures", "--config", "cases={weak: {f20_hat: 0.4}}")
    assert {"fig10_10", "fig10_11"} <= planned
    assert not {"fig10_06", "fig10_09"} & planned


def test_a_wrong_config_is_one_line_and_costs_nothing(rebuilt):
    said = rebuilt.snakemake("--config", "system={kapa: 0.6}", check=False)
    assert rebuilt.returncode != 0
    assert "Traceback" not in said
    assert "system.kapa: unknown key, did you mean 'kappa'?" in said
    assert (rebuilt / "results/fixed_points.csv").exists()


def test_a_figure_of_a_fixed_point_that_is_not_there_fails_in_its_job(rebuilt):
    rebuilt.edit("config/config.yaml", "fixed_point: c", "fixed_point: d")
    said = rebuilt.snakemake("fig10_07", check=False)
    assert rebuilt.returncode != 0
    assert "fixed_point" in said
    assert "'d'" in said


def test_a_figure_unlike_its_reference_fails_the_check_alone_which_says_how_to_accept_it(rebuilt):
    reference = rebuilt / "figures/fig10_04.csv"
    table = tables.read(reference)
    tables.write(table.assign(B=1.01 * table["B"]), reference)
    said = rebuilt.snakemake("figure_check", check=False)
    assert rebuilt.returncode != 0
    verdicts = json.loads((rebuilt / "results/figure_check/figure_check.json").read_text())
    assert {verdict["figure"] for verdict in verdicts} == {*FIGURES, "grazing", "stress_tests", "work_precision"}
    assert {verdict["figure"] for verdict in verdicts if verdict["status"] != "passed"} == {"fig10_04"}
    assert 'To accept intended changes: make accept REASON="why" FIGURES="fig10_04"\n' in said


@pytest.mark.thorough
def test_two_builds_give_the_same_bytes(built, tree):
    """Files with run times are excepted."""
    tree.snakemake()
    sums = [
        {
            str(path.relative_to(one / RECORDS)): json.loads(path.read_text())["sha256"]
            for path in (one / RECORDS).rglob("*.json")
        }
        for one in (built, tree)
    ]
    others = {name for name in sums[0] if sums[0][name] != sums[1].get(name)}
    assert all("/accuracy/" in name or "provenance" in name or "index.html" in name for name in others), others
