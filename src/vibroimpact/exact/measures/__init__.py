"""Measures of a simulated motion: period, symmetry, impacts per cycle, slow variables, bursts."""
