"""The figures: compute(...) -> tables, draw(tables) -> Figure."""
