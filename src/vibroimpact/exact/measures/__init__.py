"""Measure the period, symmetry, impacts per cycle, slow variables and resonant bursts of a simulated motion."""
