"""Test build and figure check for a config with your own cases and figures, which differ from the chapter's."""

import pytest

from own_cases import OWN_FIGURES, edit, own, single
from pipeline_trees import run_module

CONFIG = "config/config.yaml"


@pytest.mark.thorough
def test_own_cases_and_figures_are_built_and_checked(rebuilt):
    edit(rebuilt, CONFIG, own)
    rebuilt.snakemake()
    results = rebuilt / "results"
    for figure in OWN_FIGURES:
        assert (results / f"figures/{figure}.png").stat().st_size > 10_000
    assert "Simulated motion of case A b" in (results / "notebooks/strong_motion.html").read_text(encoding="utf-8")
    still = (results / "notebooks/still_motion.html").read_text(encoding="utf-8")
    assert all(f"Ball {module} has no impact in the window" in still for module in (1, 2))
    assert "no swells</td>" in still
    assert "None</td>" not in still
    levels = (results / "accuracy/models.csv").read_text(encoding="utf-8")
    assert all(f"\n{figure}," in levels for figure in OWN_FIGURES)

    output = rebuilt.snakemake("figure_check", check=False)
    assert rebuilt.returncode == 1
    assert all(f"{figure}: failed: no reference" in output for figure in OWN_FIGURES)
    status, printed = run_module(rebuilt.path, "vibroimpact_pipeline.figure_check.accept", "--reason", "one's own")
    assert status == 0, printed
    rebuilt.snakemake("figure_check")


def test_a_single_case_of_another_name_is_planned_up_to_the_figure_check(rebuilt):
    edit(rebuilt, CONFIG, single)
    rules = rebuilt.planned("all", "figure_check")
    assert {"fig10_06", "index", "figure_check"} <= rules
    assert not {"fig10_09", "fig10_10", "fig10_11"} & rules


def test_a_figure_that_the_config_lacks_is_refused_with_its_key(tree):
    (tree / "small.yaml").write_text("figures: {fig10_09: null}", encoding="utf-8")
    output = tree.dry_run("--configfile", "small.yaml", "--", "fig10_09")
    assert tree.returncode == 1
    assert "figures.fig10_09: missing in the config, or its case is missing" in output
