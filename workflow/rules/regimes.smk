# What the exact system does: branches, where chaos and periodic motions coexist, modulated motions in numbers, basins, the
# limit of small epsilon.

REGIMES = config["regimes"]


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
        settings=REGIMES["confusion"],
        observation=REGIMES["observation"],
        code=code("workflow/scripts/confusion.py"),
    log:
        "results/logs/regimes/confusion.log",
    benchmark:
        "results/benchmarks/regimes/confusion.tsv"
    script:
        "../scripts/confusion.py"


# Not part of the default build: snakemake ladder_grid
rule ladder_grid:
    output:
        "results/regimes/ladder_grid.csv",
    params:
        system=next(iter(all_systems().values())),
        settings=config["stability"]["verdict_grid"],
        code=code("workflow/scripts/ladder_grid.py"),
    log:
        "results/logs/regimes/ladder_grid.log",
    benchmark:
        "results/benchmarks/regimes/ladder_grid.tsv"
    script:
        "../scripts/ladder_grid.py"
