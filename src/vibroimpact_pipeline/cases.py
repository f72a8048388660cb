"""Assign a case to every config entry: the case that the entry names, or else `default_case`."""

import copy

from vibroimpact.system.chapter import CASES

SINGLE = ("regimes.branches", "regimes.basins")
COLLECTIONS = ("accuracy.problems", "sweeps")


def with_cases(config: dict) -> dict:
    """Return a copy of a config in which entries without a case get the default case.

    The chapter's figures (fig10_...) are an exception: they must name their case. The config may omit a case of the
    chapter. If so, entries of `figures` and `regimes.epsilon` that name the omitted case are removed. Entries in other
    parts of the config that name the omitted case get the default case. If `default_case` is missing, the first case is
    the default. Malformed entries are left unchanged; validation reports them.
    """
    config = copy.deepcopy(config)
    cases = config.get("cases")
    if not isinstance(cases, dict) or not cases:
        return config
    default = config.get("default_case")
    default = default if default in list(cases) else next(iter(cases))
    missing = [case for case in CASES if cases.get(case) is None]

    figures = _at(config, "figures")
    for shown in (figures, _at(config, "regimes.epsilon")):
        for name in [name for name, entry in shown.items() if isinstance(entry, dict) and entry.get("case") in missing]:
            del shown[name]
    entries = [_at(config, entry) for entry in SINGLE]
    entries += [entry for name in COLLECTIONS for entry in _at(config, name).values()]
    entries += [entry for name, entry in figures.items() if not str(name).startswith("fig10_")]
    for entry in entries:
        if isinstance(entry, dict) and entry and entry.get("case") in (None, *missing):
            entry["case"] = default
    return config


def case_overrides(config: dict, case: str) -> dict:
    """Return the parameters that a case sets: forcing amplitudes, and values that override those of `system`."""
    return {name: value for name, value in config["cases"][case].items() if name not in ("title", "simulation")}


def title_of(config: dict, case: str) -> str:
    """Return the title of a case.

    The default title is the name of the case, followed by the parameters that override the values of `system`.
    """
    overrides = [
        f"{name} = {value}" for name, value in case_overrides(config, case).items() if name in config["system"]
    ]
    return config["cases"][case].get("title") or case + (f" ({', '.join(overrides)})" if overrides else "")


def _at(config, path):
    """Return the mapping at a key path such as "regimes.branches"; return an empty mapping if there is none."""
    for key in path.split("."):
        config = config.get(key) if isinstance(config, dict) else None
    return config if isinstance(config, dict) else {}
