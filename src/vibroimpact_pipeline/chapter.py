"""The parameters and cases of the chapter, compared with those of a config."""

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
