"""Figures beyond the chapter, built like its own: compute(...) -> tables, draw(tables) -> Figure."""

from vibroimpact.system.extras import need

need("figures", "matplotlib", "pandas")
