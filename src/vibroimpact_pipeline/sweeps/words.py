"""A sweep in words."""

from vibroimpact_pipeline.config.reading import shown

UNITS = ((1.0, "core hours"), (60.0, "core minutes"), (3600.0, "core seconds"))
"""So many of each are an hour."""


def announced(name: str, plan: dict) -> str:
    """What a sweep is going to do, in one line."""
    hours = plan["core_hours"]
    factor, unit = next((pair for pair in UNITS if hours * pair[0] >= 1), UNITS[-1])
    return (
        f"Sweep {name}: {plan['points']} points, {plan['runs']} simulated starts, about {hours * factor:.2g} {unit} "
        f"by what a few points took, in {plan['tiles']} tile{'s' * (plan['tiles'] != 1)}."
    )


def axis_words(axis: dict) -> str:
    """The axis as the config has it."""
    together = ", ".join(axis["along"])
    for stated in ("listed", "tuples"):
        if stated in axis:
            return f"{together}: {shown(axis[stated])}"
    low, high = axis["range"]
    if "cells" in axis:
        return f"{together}: centres of {axis['cells']} cells from {low:g} to {high:g}"
    return f"{together}: {axis['values']} values from {low:g} to {high:g}, {axis.get('scale', 'linear')}"
