"""Figures: in the module of each figure, `compute` returns tables, and `draw` draws the figure from these tables."""

from vibroimpact.system.extras import need

need("figures", "matplotlib", "pandas")
