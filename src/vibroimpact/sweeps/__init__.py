"""Sweeps: one or two parameters moved over a grid, what is observed at each point, and what that costs."""
