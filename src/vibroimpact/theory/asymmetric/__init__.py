"""Motions with two unequal flights per cycle: their branch of the manifold, the slow flow on it, all its fixed points."""
