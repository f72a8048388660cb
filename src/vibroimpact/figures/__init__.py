"""Figures of the chapter: compute(...) -> tables, draw(tables) -> Figure."""

from vibroimpact.system.extras import need

need("figures", "matplotlib", "pandas")
