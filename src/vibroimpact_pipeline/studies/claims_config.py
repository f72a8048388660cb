"""Determine which parts of the evidence for the claims a config changes."""

import hashlib
import json

from vibroimpact_pipeline.chapter import departures


def unknown_entries(config: dict, known: dict[str, str]) -> list[str]:
    """Return one line for each config entry that differs from the entry that the claims were written for.

    Args:
        config: the config.
        known: digest (see `digest`) of each entry by its dotted path.
    """
    others = [path for path, digest in known.items() if _digest_at(config, path) != digest]
    return [f"{path} differs from the entry for which docs/studies/claims.yaml was written" for path in others]


TABLES = {
    "cases.equal.simulation": ("simulations.equal",),
    "cases.weak.simulation": ("simulations.weak",),
    "stability.verdict_grid": ("verdict_grid",),
    "regimes.observation": ("modulation", "special_points", "absorber", "clearance"),
    "regimes.branches": ("special_points",),
    "regimes.modulation": ("modulation",),
    "regimes.epsilon": ("epsilon_orders",),
    "sweeps.frequency_response": ("absorber",),
    "sweeps.clearance": ("absorber", "clearance"),
    "sweeps.design": ("absorber",),
}
"""Parts of the evidence that depend on each entry of the config."""


def departures_by_part(config: dict, known: dict[str, str]) -> dict[str, str]:
    """Return for parts of the evidence, by name, why they do not apply to the chapter (see `studies.claims.evidence`).

    Args:
        config: the config.
        known: as in `unknown_entries`.
    """
    found = {}
    for line in departures(config):
        section, name = line.split(" ")[0].split(".")[:2]
        found.setdefault("system" if section == "system" else name, line)
    for line in unknown_entries(config, known):
        for part in TABLES[line.split(" ")[0]]:
            found.setdefault(part, line)
    return found


def _digest_at(config, path):
    for key in path.split("."):
        if key not in config:
            return None
        config = config[key]
    return digest(config)


def digest(entry) -> str:
    """Return a short digest of a config entry."""
    return hashlib.sha256(json.dumps(entry, sort_keys=True).encode()).hexdigest()[:12]
