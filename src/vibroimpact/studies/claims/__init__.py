"""The chapter's claims, each judged by a check that computes."""

from vibroimpact.system.extras import need

need("figures", "pandas")
