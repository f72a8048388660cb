# Definitions for the rules of the studies.


def companion(figure, case=None, systems=False, settings=(), inputs={}, needs=(), outputs=None):
    """Return inputs, outputs and params of a figure, or None if the config lacks an entry that the figure needs."""
    try:
        case = at(config, case) if case else None
        inputs = {name: path.format(case=case, model="float64") for name, path in inputs.items()}
        swept = [f"sweeps.{Path(path).stem}" for path in inputs.values() if path.startswith("results/sweeps/")]
        entries([*swept, *(path.format(case=case) for path in needs)])
        params = figure_params(figure, [path.format(case=case) for path in settings], case, systems)
    except LookupError:
        return None
    return SimpleNamespace(inputs=inputs, outputs=outputs or files(figure, "Companion figures"), params=params)


def sweep_request(sweep):
    """Return all settings that affect the numbers of a sweep, in the form of vibroimpact.studies.sweeps.spec.parsed."""
    spec = {name: sweep[name] for name in ("observe", "starts", "seed", "cycles", "settle", "band") if name in sweep}
    if "regimes" in sweep["observe"]:
        spec["observation"] = config["regimes"]["observation"]
    return {"system": system_of(sweep["case"]), "axes": sweep["axes"], "spec": spec}
