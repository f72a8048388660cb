"""The profile for Slurm and the rules that it is about; read, since most machines have no Slurm."""

import csv
import re

import yaml

from pipeline_trees import ROOT

PROFILES = {
    name: yaml.safe_load((ROOT / f"workflow/profiles/{name}/config.yaml").read_text()) for name in ("default", "slurm")
}
RULES = "".join(path.read_text() for path in sorted((ROOT / "workflow/rules").glob("*.smk")))


def scheduled() -> set[str]:
    [names] = re.findall(r"^SCHEDULED = \{\n(.*?)^\}", RULES, re.MULTILINE | re.DOTALL)
    return set(re.findall(r'"(\w+)"', names))


def test_a_build_is_the_same_on_both():
    """All that decides what is made again and of what is said; a number of cores has no meaning on many machines."""
    here, there = PROFILES["default"], PROFILES["slurm"]
    assert {name: there.get(name) for name in here if name != "cores"} == {
        name: value for name, value in here.items() if name != "cores"
    }


def test_what_is_scheduled_is_a_rule():
    for name in scheduled():
        assert re.search(rf"\brule {name}\b|\"{name}\": ", RULES), name


def test_the_profile_sets_resources_of_scheduled_rules_alone():
    """But for the plan of a sweep, whose resource says how long the tiles take."""
    profile = PROFILES["slurm"]
    assert set(profile["set-resources"]) | set(profile["set-threads"]) <= scheduled() | {"plan_of_sweep"}


def test_a_tile_has_several_times_the_time_that_the_plan_gives_it():
    """The plan measures a few points, on the node of the probe."""
    asked = PROFILES["slurm"]["set-resources"]
    assert 60 * int(asked["tile_of_sweep"]["runtime"].removesuffix("m")) >= 5 * asked["plan_of_sweep"]["tile_seconds"]
    assert {"probe_of_sweep", "tile_of_sweep"} <= scheduled()
    assert "plan_of_sweep" not in scheduled()


def test_what_times_things_is_alone_on_its_node():
    alone = {rule for rule, asked in PROFILES["slurm"]["set-resources"].items() if "--exclusive" in str(asked)}
    assert alone == {"work_precision", "work_precision_full", "scene_models"}


def test_jobs_ask_for_what_they_were_measured_to_need(built):
    """Twice the memory of a job at most times fits, and a tenth of the time: as the profile says."""
    profile = PROFILES["slurm"]
    for path in (built / "results/benchmarks").rglob("*.tsv"):
        rule = "tile_of_sweep" if "-of-" in path.stem else path.stem
        if rule in scheduled():
            asked = profile["default-resources"] | profile["set-resources"].get(rule, {})
            with open(path, encoding="utf-8") as file:
                [used] = csv.DictReader(file, delimiter="\t")
            assert 1.5 * float(used["max_rss"]) < asked["mem_mb"], rule
            assert 2 * float(used["s"]) < 60 * int(asked["runtime"].removesuffix("m")), rule
