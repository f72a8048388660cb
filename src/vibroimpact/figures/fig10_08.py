"""Figure 10.8: the simulated motion of the second module."""

from vibroimpact.figures.kit.simulated import compute, draw

__all__ = ["compute", "draw"]
