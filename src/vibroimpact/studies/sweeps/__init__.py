"""Sweeps of one or two parameters over a grid: observations at each point, and their cost."""
