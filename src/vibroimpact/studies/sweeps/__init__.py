"""Sweeps over a grid with one or two axes: observations at each point of the grid, and their computing time."""
