# Shared by the rules of the studies.

# Relative to the files of the rules.
CAPTION = "../../../report/caption.rst"


def companion(figure, case=None, systems=False, settings=(), inputs={}, needs=(), folder=None):
    """Return inputs, outputs and params of a figure, or None if the config lacks an entry that it needs.

    A figure with a `folder` of its own is for an interactive page; its module also returns the data of the page.
    """
    try:
        case = at(config, case) if case else None
        inputs = {name: path.format(case=case, model="float64") for name, path in inputs.items()}
        swept = [f"sweeps.{Path(path).stem}" for path in inputs.values() if path.startswith("results/sweeps/")]
        entries([*swept, *(path.format(case=case) for path in needs)])
        params = figure_params(figure, [path.format(case=case) for path in settings], case, systems)
    except LookupError:
        return None
    outputs = files(figure, "Companion figures", CAPTION)
    if folder:
        outputs = figure_files(f"results/{folder}/{figure}", spec(figure)["tables"])
        outputs |= {kind: f"results/{folder}/{figure}.{kind}" for kind in ("json", *spec(figure).get("animated", []))}
    return SimpleNamespace(inputs=inputs, outputs=outputs, params=params)


def sweep_request(sweep):
    """Return the settings on which the numbers of a sweep depend, as in vibroimpact.studies.sweeps.request."""
    spec = {name: sweep[name] for name in ("observe", "starts", "seed", "cycles", "settle", "band") if name in sweep}
    if "regimes" in sweep["observe"]:
        spec["observation"] = config["regimes"]["observation"]
    return {"system": system_of(sweep["case"]), "axes": sweep["axes"], "spec": spec}


def arithmetic(scene):
    """Return the model of a simulation to show: reference if the case sets `digits`, otherwise float64."""
    return "reference" if "digits" in config["cases"][scene["case"]]["simulation"] else "float64"
