# What the exact system does: branches, a map of regimes, modulated motions in numbers, basins, the limit of small
# epsilon. The map is computed in tiles, a job each, so that a finer one spreads over the cores of any executor.

REGIMES = config["regimes"]


scattergather:
    regime_map=REGIMES["map"]["tiles"],


rule regime_tile:
    output:
        "results/regimes/map/{scatteritem}.csv",
    params:
        system=next(iter(all_systems().values())),
        settings={key: value for key, value in REGIMES["map"].items() if key != "tiles"},
        observation=REGIMES["observation"],
        code=code("workflow/scripts/regime_tile.py"),
    log:
        "results/logs/regimes/map/{scatteritem}.log",
    benchmark:
        "results/benchmarks/regimes/map/{scatteritem}.tsv"
    script:
        "../scripts/regime_tile.py"
