"""Figures. In the module of a figure, `compute` returns its tables, and `draw` draws the figure from the tables."""

from vibroimpact.system.extras import need

need("figures", "matplotlib", "pandas")
