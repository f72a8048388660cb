"""Judge each claim of the chapter by a computed check."""

from vibroimpact.system.extras import need

need("figures", "pandas")
