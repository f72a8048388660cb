"""A config with cases and figures of one's own: built, checked and reported to the end, and told from the chapter's."""

import json

import pytest
import yaml

from pipeline_trees import run_module

SIMULATION = {"initial_state": [0.0] * 8, "transient_cycles": 300, "window_cycles": 6, "samples_per_cycle": 64}
OWN_FIGURES = {
    "strong_response": {
        "notebook": "theoretical_response",
        "model": "slow_flow",
        "case": "strong",
        "fixed_point": "b",
        "periods": 3,
    },
    "strong_motion": {"notebook": "simulation", "model": "simulation", "case": "strong"},
    "still_planes": {"notebook": "fixed_points", "model": "slow_flow", "case": "still", "C_max": [2.5, 3.5]},
    "still_motion": {"notebook": "simulation", "model": "simulation", "case": "still"},
}
"""Each kind of notebook that takes a case; `still` is too weakly driven to have a fixed point or an impact."""


def renamed(config, old, new):
    """A config in which a case has another name, everywhere."""
    text = yaml.safe_dump(config, sort_keys=False)
    return yaml.safe_load(text.replace(f"case: {old}\n", f"case: {new}\n").replace(f"  {old}:\n", f"  {new}:\n"))


def without_case(config, case):
    """A config without a case and what shows it."""
    del config["cases"][case]
    for section in (config["figures"], config["accuracy"]["problems"], config["report"]["animations"]):
        for name in [name for name, scene in section.items() if scene.get("case") == case]:
            del section[name]


def hurried(config):
    """A config that asks the exact system little, as it is not about that here."""
    regimes = config["regimes"]
    regimes["branches"] |= {"paths": [{"along": ["f20_hat"], "range": [0.9, 1.0]}], "seeds": 1}
    regimes["branches"]["attractors"] |= {"values": 3, "starts": 2}
    regimes["modulation"] |= {"starts": 2, "cycles": 60, "blocks": 2, "windows": [60]}
    regimes["basins"]["points"] = 5
    regimes["epsilon"]["values"] = 5  # three of them are small: the order has an uncertainty
    problems = config["accuracy"]["problems"]
    config["accuracy"]["problems"] = {"transient": problems["transient"]}


@pytest.fixture
def edited(rebuilt):
    """Changes the config of a built tree by a function of it."""
    path = rebuilt / "config/config.yaml"

    def edit(change):
        config = yaml.safe_load(path.read_text(encoding="utf-8"))
        config = change(config) or config
        path.write_text(yaml.safe_dump(config, sort_keys=False), encoding="utf-8")
        return rebuilt

    return edit


def own(config):
    """Two cases and five figures more; one case of the chapter renamed, one gone."""
    config = renamed(config, "unequal", "uneven")
    without_case(config, "weak")
    hurried(config)
    config["cases"]["strong"] = {"title": "A b", "f10_hat": 1.0, "f20_hat": 0.95, "simulation": SIMULATION}
    config["cases"]["still"] = {"f10_hat": 0.05, "f20_hat": 0.0, "simulation": SIMULATION}
    config["figures"] |= OWN_FIGURES
    config["report"]["animations"]["strong_in_motion"] = {"case": "strong", "cycles": 2}
    return config


@pytest.mark.thorough
def test_own_cases_and_figures_go_through_figures_check_and_report(edited):
    tree = edited(own)
    tree.snakemake("all", "report")
    results = tree / "results"
    for figure in OWN_FIGURES:
        assert (results / f"figures/{figure}.png").stat().st_size > 10_000
        assert figure in (results / "report/figures.html").read_text(encoding="utf-8")
    for page in ("report/figures.html", "notebooks/strong_motion.html"):
        assert "Simulated motion of case A b" in (results / page).read_text(encoding="utf-8")
    still = (results / "notebooks/still_motion.html").read_text(encoding="utf-8")
    assert all(f"Ball {module} has no impact in the window" in still for module in (1, 2))
    assert "no swells</td>" in still
    assert "None</td>" not in still
    levels = (results / "accuracy/scene_models.csv").read_text(encoding="utf-8")
    assert all(f"\n{figure}," in levels for figure in OWN_FIGURES)

    output = tree.snakemake("figure_check", check=False)
    assert tree.returncode == 1
    assert all(f"{figure}: failed: no reference" in output for figure in OWN_FIGURES)
    status, said = run_module(tree.path, "vibroimpact_pipeline.figure_check.accept", "--reason", "figures of one's own")
    assert status == 0, said
    tree.snakemake("figure_check")

    reasons = ["there is no case unequal", "there is no case weak"]
    claims = json.loads((results / "claims.json").read_text(encoding="utf-8"))
    verdicts = {claim["id"]: claim["verdict"] for claim in claims}
    assert verdicts["two-branches"] == "holds in part"  # which no case decides on
    assert {claim["verdict"] for claim in claims if "weak" in str(claim.get("arguments"))} == {"not judged"}
    pages = [path for path in (results / "report").glob("*.html") if path.name != "search.html"]  # the generator's own
    pages.append(results / "claims.md")
    for page in pages:
        text = page.read_text(encoding="utf-8")
        assert all(reason in text for reason in reasons), page


def single(config):
    """The case `equal` alone, under another name, with the chapter's figures of it."""
    for case in ("unequal", "weak"):
        without_case(config, case)
    config = renamed(renamed(config, "unequal", "equal"), "equal", "alone")
    config["regimes"]["epsilon"]["mixed"]["case"] = "alone"
    return config


def test_a_single_case_of_another_name_is_planned_to_the_end(edited):
    tree = edited(single)
    output = tree.dry_run("all", "report", "figure_check")
    assert tree.returncode == 0, output
    rules = tree.planned("all", "report")
    assert {"fig10_06", "companion_branches", "claims", "report"} <= rules
    assert not {"fig10_09", "fig10_10", "fig10_11", "companion_horizon"} & rules


def test_what_is_left_of_a_figure_that_is_gone_is_named(tree):
    (tree / "results/figures").mkdir(parents=True)
    for name in ("my_planes.provenance.json", ".partial-my_motion.provenance.json", "fig10_02.provenance.json"):
        (tree / "results/figures" / name).write_text("{}", encoding="utf-8")
    output = tree.snakemake("fig10_01")
    assert "In results/figures, but not of this config: my_planes. They may be deleted." in output
    assert (tree / "results/figures/my_planes.provenance.json").exists()


def test_a_figure_that_the_config_lacks_is_refused_with_its_key(tree):
    (tree / "small.yaml").write_text("figures: {fig10_09: null}", encoding="utf-8")
    output = tree.dry_run("--configfile", "small.yaml", "--", "fig10_09")
    assert tree.returncode == 1
    assert "figures.fig10_09: the config has no such figure, or not its case." in output
