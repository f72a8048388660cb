"""A rule reruns when its slice of the config, its script, or the code it uses changes, and not otherwise."""

import os

import pytest

CLOSED_FORM = {"fig10_03", "fig10_04", "fig10_05"}
OF_CASE = {
    "equal": {"fig10_06", "fig10_07", "fig10_08"},
    "unequal": {"fig10_09"},
    "weak": {"fig10_10", "fig10_11"},
}


def test_with_nothing_changed_nothing_is_planned(rebuilt):
    assert rebuilt.planned() == set()


def test_touched_files_rebuild_nothing(rebuilt):
    for name in ("src", "workflow", "notebooks", "config", "Snakefile", "results"):
        for path in [rebuilt / name, *(rebuilt / name).rglob("*")]:
            os.utime(path)
    assert rebuilt.planned() == set()


@pytest.mark.parametrize("case", OF_CASE)
def test_the_amplitude_of_a_case_rebuilds_the_figures_of_this_case(rebuilt, case):
    config = (rebuilt / "config/config.yaml").read_text()
    before, after = config.split(f"  {case}:\n")
    amplitude = after.split("f20_hat: ")[1].split("\n")[0]
    (rebuilt / "config/config.yaml").write_text(
        f"{before}  {case}:\n" + after.replace(f"f20_hat: {amplitude}", "f20_hat: 0.7", 1)
    )
    figures = {rule for rule in rebuilt.planned() if rule.startswith("fig")}
    assert figures == OF_CASE[case]


def test_the_scene_of_a_figure_rebuilds_this_figure(rebuilt):
    rebuilt.edit("config/config.yaml", "fixed_point: c, periods: 2", "fixed_point: c, periods: 3")
    assert rebuilt.planned("figures") == {"fig10_07"}


def test_a_longer_simulation_rebuilds_no_algebra(rebuilt):
    shorter = ("--config", "cases={weak: {simulation: {transient_cycles: 7}}}")
    assert rebuilt.planned("figures", *shorter) == {"simulation", "fig10_11"}
    assert not rebuilt.planned("stability", *shorter)


def test_results_of_a_version_that_wrote_fewer_files_are_not_taken_as_they_are(rebuilt):
    (rebuilt / "results/simulations/equal/strobe.csv").unlink()
    assert "simulation" in rebuilt.planned("figures", "--config", "cases={equal: {simulation: {window_cycles: 5}}}")


def test_an_edited_library_module_rebuilds_what_uses_it(rebuilt):
    with open(rebuilt / "src/vibroimpact/exact/engine/simulation.py", "a") as module:
        module.write("\n# edited\n")
    assert rebuilt.planned("figures") == {"simulation", "fig10_08", "fig10_11", "machines"}


def test_an_edited_figure_module_rebuilds_the_figures_it_draws(rebuilt):
    with open(rebuilt / "src/vibroimpact/figures/fig10_04.py", "a") as module:
        module.write("\n# edited\n")
    assert rebuilt.planned("figures") == {"fig10_04"}


def test_an_edited_notebook_rebuilds_its_figures(rebuilt):
    rebuilt.edit("notebooks/closed_form.ipynb", "What follows in closed form", "What follows")
    assert rebuilt.planned("figures") == CLOSED_FORM


def test_an_edited_script_rebuilds_what_it_makes(rebuilt):
    rebuilt.edit("workflow/scripts/gather.py", "one table", "a single table")
    planned = rebuilt.planned("stability", "companion_stability", "claims")
    assert planned == {"gather_fixed_points", "gather_orbits", "companion_stability", "claims"}


def test_an_edited_claim_rebuilds_the_claims_alone(rebuilt):
    rebuilt.edit("docs/claims.yaml", "is small against the mass", "is small beside the mass")
    assert rebuilt.planned("stability", "companion_stability", "claims") == {"claims"}


def test_claims_in_a_build_with_other_parameters_are_marked_and_wait_for_nothing(rebuilt):
    other = ["--config", "cases={weak: {f20_hat: 0.6}}"]
    assert rebuilt.planned("claims", *other) == {"claims"}
    rebuilt.snakemake("claims", *other)
    text = (rebuilt / "results/claims.md").read_text(encoding="utf-8")
    assert "Not judged" in text
    assert "- cases.weak.f20_hat is 0.6, not 0.5" in text
    assert rebuilt.planned("claims") == {"claims"}
    assert rebuilt.planned("claims", "--config", "regimes={modulation: {starts: 15}}") == {"claims"}


def test_the_amplitude_of_a_case_rebuilds_its_orbits_and_what_shows_all_cases(rebuilt):
    planned = rebuilt.planned("stability", "companion_stability", "--config", "cases={weak: {f20_hat: 0.6}}")
    assert planned == {
        "fixed_points",
        "orbits",
        "verdicts",
        "gather_fixed_points",
        "gather_orbits",
        "proofs",
        "companion_stability",
    }


def test_a_deleted_figure_is_made_again_alone(rebuilt):
    (rebuilt / "results/figures/fig10_05.svg").unlink()
    assert rebuilt.planned("figures") == {"fig10_05"}


TABLES = {
    "fixed_points": "fixed_points/weak.csv",
    "orbits": "orbits/weak.csv",
    "verdicts": "verdicts/weak.csv",
    "table_of_sweep": "sweeps/regime_map.csv",
}


@pytest.mark.parametrize("rule", TABLES)
def test_a_deleted_table_is_made_again_though_what_was_made_of_it_is_there(rebuilt, rule):
    (rebuilt / "results" / TABLES[rule]).unlink()
    assert rule in rebuilt.planned()


def test_a_figure_is_a_target(rebuilt):
    assert rebuilt.planned("--forceall", "fig10_06") == {"fixed_points", "fig10_06"}


def test_a_changed_lock_or_test_or_document_rebuilds_nothing(rebuilt):
    for name in ("environment.lock", "README.md", "src/vibroimpact_pipeline/config/check.py"):
        assert (rebuilt / name).is_file()
        with open(rebuilt / name, "a") as file:
            file.write("\n# edited\n")
    assert rebuilt.planned() == set()
