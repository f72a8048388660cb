"""Prove single orbits in interval arithmetic (python-flint): existence, motion between the walls, multipliers."""

from vibroimpact.system.extras import need

need("reference", "flint")
