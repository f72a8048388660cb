"""The figures of the chapter: compute(...) -> tables, draw(tables) -> Figure."""
