"""Figure 10.9: fixed points and singular points for unequal forces, drawn as figure 10.6."""

from vibroimpact.figures.fig10_06 import compute, draw

__all__ = ["compute", "draw"]
