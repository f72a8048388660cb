"""Judge the claims of the chapter, each by a check that computes."""

from vibroimpact.system.extras import need

need("figures", "pandas")
