"""Sweeps: one or two parameters moved over a grid, observations at each point, and their cost."""
