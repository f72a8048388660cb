"""Decide whether a config has the parameters and settings for which the claims of the chapter were written."""

import hashlib
import json

from vibroimpact_pipeline.chapter import departures

JUDGED_WITH = "ec3468120a00"
"""Digest of the settings for which the claims were written (see `digest`)."""


def reason_not_judged(config: dict) -> str:
    """Return the reason why claims cannot be judged with a config, or an empty text if they can be judged."""
    found = departures(config)
    if not found and digest(config) != JUDGED_WITH:
        found = ["simulations, stability.verdict_grid or regimes differ from those for which the claims were written"]
    return next(iter(found), "")


def digest(config: dict) -> str:
    """Return a short digest of all settings that affect verdicts on claims.

    The digest does not cover the parameters of the chapter, which `departures` compares.
    """
    settings = [config["cases"][case]["simulation"] for case in ("equal", "weak")]
    settings += [config["stability"]["verdict_grid"]]
    settings += [config["regimes"][name] for name in ("observation", "branches", "modulation", "epsilon")]
    return hashlib.sha256(json.dumps(settings, sort_keys=True).encode()).hexdigest()[:12]
