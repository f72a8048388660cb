"""Measure period, symmetry, impacts per cycle, slow variables and bursts of a simulated motion."""
