"""What the config asks for, against what a computer can do; every estimate is of the worst case."""

from math import prod

from vibroimpact_pipeline.config.section import Place, Problem

CYCLES = 2e10
"""Forcing cycles of one job: half a million in a second, a night in all."""
HELD = 4_000_000
"""Forcing cycles whose events are held in memory at once, a kilobyte each."""


def above(place: Place, limit: float, what: str, **factors: float) -> list[Problem]:
    """The problem that so many (a product of what keys ask for) are more than a limit."""
    asked = prod(factors.values())
    if asked <= limit:
        return []
    product = " x ".join(f"{value:.6g} {name}" for name, value in factors.items())
    return [Problem(place, f"{product} = {asked:.3g} {what}, above {limit:.3g}")]
