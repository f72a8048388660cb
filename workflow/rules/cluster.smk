# On a cluster: what is worth a scheduler's while. The other jobs take seconds, which is less than it takes to ask for a
# place and to hear that they are done; they run where Snakemake itself runs. On one machine nothing changes.

SCHEDULED = {
    "probe_of_sweep",
    "tile_of_sweep",
    "confusion",
    "ladder_grid",
    "verdict_grid",
    "coexistence",
    "companion_branches",
    "companion_basins",
    "hazards",
    "hazards_full",
    # These time things: alone on a node, which a machine that people log in to is not.
    "work_precision",
    "work_precision_full",
    "scene_models",
}


def quick():
    """The rules of this pipeline, by the names that a workflow around it gives them, that go to no scheduler."""
    scheduled = {workflow.modifier.modify_rulename(name) for name in SCHEDULED}
    own = [rule.name for rule in workflow.rules if Path(rule.snakefile).is_relative_to(ROOT / "workflow")]
    return set(own) - scheduled


workflow.localrules(*quick())
