"""Compare the parameters and cases of a config with those of the chapter."""

from vibroimpact.system.chapter import CASES, PARAMETERS
from vibroimpact_pipeline.cases import case_overrides

CASE_OF = {
    "fig10_06": "equal",
    "fig10_07": "equal",
    "fig10_08": "equal",
    "fig10_09": "unequal",
    "fig10_10": "weak",
    "fig10_11": "weak",
}
"""Case of each figure of the chapter."""


def departures(config: dict) -> list[str]:
    """Return one line for each difference between a config and section 10.4 of the chapter."""
    found = _differences("system", config["system"], PARAMETERS)
    for case, forces in CASES.items():
        if case in config["cases"]:
            found += _differences(f"cases.{case}", PARAMETERS | case_overrides(config, case), PARAMETERS | forces)
        else:
            found.append(f"cases.{case} is missing")
    return found


def _differences(place, given, printed):
    return [
        f"{place}.{name} is {given[name]} instead of {value}" for name, value in printed.items() if given[name] != value
    ]
