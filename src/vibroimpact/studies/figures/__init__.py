"""Figures that are not in the chapter; each has two functions, compute(...) -> tables and draw(tables) -> Figure."""

from vibroimpact.system.extras import need

need("figures", "matplotlib", "pandas")
