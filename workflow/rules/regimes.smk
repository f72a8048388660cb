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


rule coexistence:
    output:
        lifetimes="results/regimes/lifetimes.csv",
        tori="results/regimes/tori.csv",
        onsets="results/regimes/torus_onsets.csv",
    params:
        system=system_of(REGIMES["coexistence"]["case"]),
        lifetimes=REGIMES["coexistence"]["lifetimes"],
        tori=REGIMES["coexistence"]["tori"],
        observation=REGIMES["observation"],
        code=code("workflow/scripts/coexistence.py"),
    log:
        "results/logs/regimes/coexistence.log",
    benchmark:
        "results/benchmarks/regimes/coexistence.tsv"
    script:
        "../scripts/coexistence.py"


# Not part of the default build: snakemake confusion
rule confusion:
    output:
        "results/regimes/confusion.csv",
    params:
        system=next(iter(all_systems().values())),
        settings={key: REGIMES["map"][key] for key in ("f10_range", "f20_range")} | REGIMES["confusion"],
        observation=REGIMES["observation"],
        code=code("workflow/scripts/confusion.py"),
    log:
        "results/logs/regimes/confusion.log",
    benchmark:
        "results/benchmarks/regimes/confusion.tsv"
    script:
        "../scripts/confusion.py"
