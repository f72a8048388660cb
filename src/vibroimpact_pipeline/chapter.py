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


def unknown_entries(config: dict, seen: dict[str, str]) -> list[str]:
    """Return one line per config entry that differs from the one the claims were written for.

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
    return digest(config)


def digest(entry) -> str:
    """Return a short digest of a config entry."""
    return hashlib.sha256(json.dumps(entry, sort_keys=True).encode()).hexdigest()[:12]
