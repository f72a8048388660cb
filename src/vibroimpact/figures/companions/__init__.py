"""Figures that the chapter does not show: compute(...) -> tables, draw(tables) -> Figure."""
