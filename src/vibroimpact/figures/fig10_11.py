"""Figure 10.11: the strongly modulated response, drawn as figure 10.8."""

from vibroimpact.figures.fig10_08 import compute, draw

__all__ = ["compute", "draw"]
