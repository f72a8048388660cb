"""The parameters and cases of the chapter, compared with those of a config."""

import hashlib
import json

from vibroimpact.system.chapter import CASES, PARAMETERS
from vibroimpact_pipeline.cases import own_parameters

CASE_OF = {
    "fig10_06": "equal",
    "fig10_07": "equal",
    "fig10_08": "equal",
    "fig10_09": "unequal",
    "fig10_10": "weak",
    "fig10_11": "weak",
}
"""Case shown by each figure of the chapter."""


def departures(config: dict) -> list[str]:
    """Return one line per difference between a config and section 10.4; additional cases are not differences."""
    found = _differences("system", config["system"], PARAMETERS)
    for case, forces in CASES.items():
        if case in config["cases"]:
            found += _differences(f"cases.{case}", PARAMETERS | own_parameters(config, case), PARAMETERS | forces)
        else:
            found.append(f"there is no case {case}")
    return found


def _differences(place, given, printed):
    return [f"{place}.{name} is {given[name]}, not {value}" for name, value in printed.items() if given[name] != value]


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
