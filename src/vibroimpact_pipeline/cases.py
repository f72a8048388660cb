"""The case of every entry of a config: named by the entry, or else `default_case`. Standard library only."""

import copy

CHAPTER = ("equal", "unequal", "weak")
"""Cases of the chapter. A config may do without them: see `with_cases`."""
SINGLE = ("accuracy.benchmark", "report.force_sweep", "regimes.branches", "regimes.basins")
COLLECTIONS = ("accuracy.problems", "report.animations", "sweeps")


def with_cases(config: dict) -> dict:
    """Return a copy of a config in which every entry that is about a case names it.

    An entry without a case takes `default_case`, which is the first case unless the config says otherwise; figures of
    the chapter have to name theirs. If a case of the chapter is not among the cases, what shows it is left out
    (figures, animations, the mixed point of `regimes.epsilon`), and all other entries about it take the default.
    Anything malformed is left for the check of the config.
    """
    config = copy.deepcopy(config)
    cases = config.get("cases")
    if not isinstance(cases, dict) or not cases:
        return config
    default = config.get("default_case")
    default = default if default in list(cases) else next(iter(cases))
    missing = [case for case in CHAPTER if cases.get(case) is None]

    figures = _at(config, "figures")
    for shown in (figures, _at(config, "report.animations"), _at(config, "regimes.epsilon")):
        for name in [name for name, entry in shown.items() if isinstance(entry, dict) and entry.get("case") in missing]:
            del shown[name]
    entries = [_at(config, entry) for entry in SINGLE]
    entries += [entry for name in COLLECTIONS for entry in _at(config, name).values()]
    entries += [entry for name, entry in figures.items() if not str(name).startswith("fig10_")]
    for entry in entries:
        if isinstance(entry, dict) and entry and entry.get("case") in (None, *missing):
            entry["case"] = default
    return config


def own_parameters(config: dict, case: str) -> dict:
    """Return the parameters of a case's own entry: its forcing amplitudes, and what differs from `system`."""
    return {name: value for name, value in config["cases"][case].items() if name not in ("title", "simulation")}


def title_of(config: dict, case: str) -> str:
    """Return the name of a case in titles and captions: its title, or else its name with what differs from `system`."""
    own = [f"{name} = {value}" for name, value in own_parameters(config, case).items() if name in config["system"]]
    return config["cases"][case].get("title") or case + (f" ({', '.join(own)})" if own else "")


def _at(config, path):
    """Return the mapping at "section.key", an empty one if there is none."""
    for key in path.split("."):
        config = config.get(key) if isinstance(config, dict) else None
    return config if isinstance(config, dict) else {}
