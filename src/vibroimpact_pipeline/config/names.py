"""Names that the rules of the pipeline take: figures and animations become rules, cases become names of inputs."""

from collections.abc import Iterator

from vibroimpact_pipeline.config.figures import Figures
from vibroimpact_pipeline.config.section import Problem

RULES = {
    "accuracy",
    "all",
    "api",
    "claims",
    "coexistence",
    "companions",
    "compare_figures",
    "confusion",
    "figure_check",
    "figures",
    "fixed_points",
    "force_sweep",
    "gather_fixed_points",
    "gather_orbits",
    "hazards",
    "hazards_full",
    "orbits",
    "proofs",
    "regime_tile",
    "report",
    "scene_models",
    "simulation",
    "stability",
    "verdict_grid",
    "verdicts",
    "work_precision",
    "work_precision_full",
}
"""Rules of workflow/rules/."""
COMPANIONS = "companion_"
"""What the names of rules of companions begin with."""
FIGURES = Figures.model_fields.keys()
"""Rules of the chapter's figures."""
RESERVED = {
    "append",
    "clear",
    "copy",
    "count",
    "extend",
    "get",
    "index",
    "insert",
    "items",
    "keys",
    "pop",
    "remove",
    "reverse",
    "sort",
    "update",
}
"""Names that no input of a rule may bear."""


def taken(config) -> Iterator[Problem]:
    """Figures, animations and cases whose names mean something else already."""
    for name in filter(_is_rule, config.figures.model_extra):
        yield Problem(("figures", name), "the name is that of a rule")
    for name in config.report.animations:
        if _is_rule(name) or name in FIGURES or name in config.figures.model_extra:
            yield Problem(("report", "animations", name), "the name is that of a rule or a figure")
    for name in filter(RESERVED.__contains__, config.cases):
        yield Problem(("cases", name), "the name is reserved by Snakemake")


def _is_rule(name):
    return name in RULES or name.startswith(COMPANIONS)
