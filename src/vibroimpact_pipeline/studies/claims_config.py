"""Which parts of the evidence for the claims a config changes."""

import hashlib
import json

from vibroimpact_pipeline.chapter import departures


def unknown_entries(config: dict, known: dict[str, str]) -> list[str]:
    """Return one line per config entry that differs from the one the claims were written for.

    Args:
        known: the digest of each entry (see `digest`) by its dotted path.
    """
    others = [path for path, digest in known.items() if _digest_at(config, path) != digest]
    return [f"{path} is not the one that docs/studies/claims.yaml knows" for path in others]


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
"""Parts of the evidence that depend on an entry of the config."""


def unlike(config: dict, known: dict[str, str]) -> dict[str, str]:
    """Return why parts of the evidence are not about the chapter, a line by part: see `studies.claims.evidence`.

    Args:
        known: as in `unknown_entries`.
    """
    found = {}
    for line in departures(config):
        place = line.removeprefix("there is no case ").split(" ")[0].split(".")
        found.setdefault("system" if place[0] == "system" else place[-1] if len(place) == 1 else place[1], line)
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
