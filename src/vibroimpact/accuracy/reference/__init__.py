"""The reference: the same motion in ball arithmetic, written independently of the engine that it judges."""

from vibroimpact.system.extras import need

need("reference", "flint")
