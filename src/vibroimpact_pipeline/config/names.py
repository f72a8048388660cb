"""Names that the rules of the pipeline take: figures and animations become rules, cases become names of inputs."""

RULES = """accuracy all archive api claims coexistence companions figure_check figure_check_strict figures fixed_points
    force_sweep gather hazards index orbits proofs report scene_models simulation stability verdict_grid verdicts
    work_precision"""
"""Rules of workflow/rules/."""
COMPANIONS, SWEEPS = "companion_", ("sweep_", "tile_", "table_")
"""What the names of rules of companions and of sweeps begin with."""
TAKEN = (COMPANIONS, *SWEEPS, "fig10_", "own_")
"""How names begin that are of companions, sweeps, the chapter's figures and texts of own figures."""


def taken(config):
    """Yield figures and animations whose names mean something else already."""
    figures = [("figures", name) for name in config.figures.model_extra]
    for *section, name in figures + [("report", "animations", name) for name in config.report.animations]:
        twice = section[0] == "report" and ("figures", name) in figures
        if twice or name in RULES.split() or name.startswith(TAKEN):
            yield (*section, name), f"the name is that of a rule or another figure, or begins with {', '.join(TAKEN)}"
