# What the exact system does: branches, a map of regimes, modulated motions in numbers, basins, the limit of small
# epsilon. The map is computed in tiles, a job each, so that a finer one spreads over the cores of any executor.

REGIMES = config["regimes"]
# Tables that a companion figure writes beside the one it plots.
COMPANION_TABLES = {
    "companion_branches": {"special_points": "results/regimes/special_points.csv"},
    "companion_regime_map": {},
    "companion_modulation": {"measures": "results/regimes/modulation.csv"},
    "companion_basins": {"shares": "results/regimes/basin_shares.csv"},
    "companion_epsilon": {"orders": "results/regimes/epsilon_orders.csv"},
}
COMPANION_MODULES = {name: name.removeprefix("companion_") for name in COMPANION_TABLES}
COMPANION_MODULES["companion_epsilon"] = "epsilon_limit"


scattergather:
    regime_map=REGIMES["map"]["tiles"],


def regime_settings(name, *without):
    """The slice of one companion, its case given as a system."""
    settings = {key: value for key, value in REGIMES[name].items() if key not in ("case", *without)}
    return settings | ({"system": system_of(REGIMES[name]["case"])} if "case" in REGIMES[name] else {})


def companion_settings():
    observation = {"observation": REGIMES["observation"]}
    forces = {case: [values["f10_hat"], values["f20_hat"]] for case, values in config["cases"].items()}
    return {
        "companion_branches": regime_settings("branches") | observation,
        "companion_regime_map": {"points": REGIMES["map"]["points"], "cases": forces},
        "companion_modulation": regime_settings("modulation") | observation | {"systems": all_systems()},
        "companion_basins": regime_settings("basins") | observation,
        "companion_epsilon": regime_settings("epsilon") | {"systems": all_systems()},
    }


def companion_outputs(name):
    kinds = {kind: f"results/figures/{name}.{kind}" for kind in ("csv", "png", "pdf", "svg")}
    return kinds | COMPANION_TABLES[name]


rule regime_tile:
    output:
        "results/regimes/map/{scatteritem}.csv",
    params:
        system=next(iter(all_systems().values())),
        settings=regime_settings("map", "tiles"),
        observation=REGIMES["observation"],
        code=code("workflow/scripts/regime_tile.py"),
    log:
        "results/logs/regimes/map/{scatteritem}.log",
    benchmark:
        "results/benchmarks/regimes/map/{scatteritem}.tsv"
    script:
        "../scripts/regime_tile.py"


for name, settings in companion_settings().items():

    rule:
        name:
            name
        input:
            tiles=gather.regime_map(rules.regime_tile.output[0]) if name == "companion_regime_map" else [],
        output:
            **in_report(companion_outputs(name), "Companion figures", name),
        params:
            module=COMPANION_MODULES[name],
            settings=settings,
            code=code("workflow/scripts/companion.py", modules=[f"vibroimpact.figures.{COMPANION_MODULES[name]}"]),
        log:
            f"results/logs/regimes/{name}.log",
        benchmark:
            f"results/benchmarks/regimes/{name}.tsv"
        script:
            "../scripts/companion.py"


rule regimes:
    input:
        [path for name in COMPANION_TABLES for path in companion_outputs(name).values()],
