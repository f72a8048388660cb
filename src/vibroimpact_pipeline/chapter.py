"""What the figures, claims and pages of the chapter need of a config: its parameters and its cases."""

import hashlib
import json

from vibroimpact.system.chapter import CASES, PARAMETERS

CASE_OF = {
    "fig10_06": "equal",
    "fig10_07": "equal",
    "fig10_08": "equal",
    "fig10_09": "unequal",
    "fig10_10": "weak",
    "fig10_11": "weak",
}
"""Whose results each figure of the chapter shows."""


def departures(config: dict) -> list[str]:
    """Where a config departs from section 10.4, a line each; what it has beside the chapter's cases is no departure."""
    found = _differences("system", config["system"], PARAMETERS)
    for case, forces in CASES.items():
        if case in config["cases"]:
            found += _differences(f"cases.{case}", config["cases"][case], forces)
        else:
            found.append(f"there is no case {case}")
    return found


def _differences(place, given, printed):
    return [f"{place}.{name} is {given[name]}, not {value}" for name, value in printed.items() if given[name] != value]


def unknown_entries(config: dict, seen: dict[str, str]) -> list[str]:
    """Entries of the config that differ from those that the claims were written with, a line each.

    Args:
        seen: the digest of each entry (see `digest`) by its dotted path.
    """
    others = [path for path, known in seen.items() if _digest_at(config, path) != known]
    return [f"{path} is not the one that docs/claims.yaml knows" for path in others]


def _digest_at(config, path):
    for key in path.split("."):
        if key not in config:
            return None
        config = config[key]
    return digest({key: value for key, value in config.items() if key != "limit_hours"})  # which decides on no number


def digest(entry) -> str:
    """Tells whether an entry of the config is the one that somebody has seen."""
    return hashlib.sha256(json.dumps(entry, sort_keys=True).encode()).hexdigest()[:12]
