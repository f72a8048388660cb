"""Names that the rules of the pipeline take: figures and animations become rules, cases become names of inputs."""

RULES = """accuracy all archive api claims coexistence companions compare_figures confusion figure_check
    figure_check_strict figures fixed_points force_sweep gather_fixed_points gather_orbits hazards hazards_full
    ladder_grid orbits page_of_sweep picture_of_sweep plan_of_sweep probe_of_sweep proofs report scene_models simulation
    stability table_of_sweep tile_of_sweep verdict_grid verdicts work_precision work_precision_full"""
"""Rules of workflow/rules/."""
COMPANIONS, SWEEPS = "companion_", "sweep_"
"""What the names of rules of companions and of sweeps begin with."""
TAKEN = (COMPANIONS, SWEEPS, "fig10_", "own_")
"""How names begin that are of companions, sweeps, the chapter's figures and texts of own figures."""


def taken(config):
    """Yield figures and animations whose names mean something else already."""
    figures = [("figures", name) for name in config.figures.model_extra]
    for *section, name in figures + [("report", "animations", name) for name in config.report.animations]:
        twice = section[0] == "report" and ("figures", name) in figures
        if twice or name in RULES.split() or name.startswith(TAKEN):
            yield (*section, name), f"the name is that of a rule or another figure, or begins with {', '.join(TAKEN)}"
