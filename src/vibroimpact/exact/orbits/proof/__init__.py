"""Prove existence, motion between the walls and stability of single orbits by interval arithmetic (python-flint)."""

from vibroimpact.system.extras import need

need("reference", "flint")
