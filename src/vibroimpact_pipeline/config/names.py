"""Names that the rules of the pipeline take: figures and animations become rules, cases become names of inputs."""

from collections.abc import Iterator

from vibroimpact_pipeline.config.section import Problem

RULES = {
    "accuracy",
    "all",
    "archive",
    "api",
    "claims",
    "coexistence",
    "companions",
    "compare_figures",
    "confusion",
    "figure_check",
    "figure_check_strict",
    "figures",
    "fixed_points",
    "force_sweep",
    "gather_fixed_points",
    "gather_orbits",
    "hazards",
    "hazards_full",
    "ladder_grid",
    "orbits",
    "page_of_sweep",
    "picture_of_sweep",
    "plan_of_sweep",
    "probe_of_sweep",
    "proofs",
    "report",
    "scene_models",
    "simulation",
    "stability",
    "table_of_sweep",
    "tile_of_sweep",
    "verdict_grid",
    "verdicts",
    "work_precision",
    "work_precision_full",
}
"""Rules of workflow/rules/."""
COMPANIONS = "companion_"
"""What the names of rules of companions begin with."""
SWEEPS = "sweep_"
"""What the names of rules of sweeps begin with."""
CHAPTERS = "fig10_"
"""What the names of the chapter's figures begin with."""


def taken(config) -> Iterator[Problem]:
    """Figures and animations whose names mean something else already."""
    for name in config.figures.model_extra:
        yield from _meant(("figures", name), name)
    for name in config.report.animations:
        yield from _meant(("report", "animations", name), name)
        if name in config.figures.model_extra:
            yield Problem(("report", "animations", name), "the name is that of a figure")


def _meant(place, name):
    if name in RULES or name.startswith((COMPANIONS, SWEEPS)):
        yield Problem(place, "the name is that of a rule")
    if name.startswith(CHAPTERS):
        yield Problem(place, f"names with {CHAPTERS} are those of the chapter's figures")
