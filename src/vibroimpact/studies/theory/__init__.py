"""Motions with two unequal flights per cycle: their branch of the manifold, and all fixed points on it."""
