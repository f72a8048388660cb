"""Reference simulation in interval arithmetic (midpoint and radius), independent of the engine that it validates."""

from vibroimpact.system.extras import need

need("reference", "flint")
