"""Reference simulation in ball arithmetic, independent of the engine that it validates."""

from vibroimpact.system.extras import need

need("reference", "flint")
