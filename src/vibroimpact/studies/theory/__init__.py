"""Slow flow with two unequal flights per cycle: branch of the manifold, fixed points, relaxation oscillations."""
