# Exact 1:1 responses of each case, the verdict of every criterion on them and on the fixed points, and what is proved.


rule orbits:
    output:
        csv="results/orbits/{case}.csv",
        search="results/orbits/{case}.search.json",
    params:
        system=lambda wildcards: system_of(wildcards.case),
        code=LIBRARY,
    log:
        "results/logs/orbits/{case}.log",
    benchmark:
        "results/benchmarks/orbits/{case}.tsv"
    conda:
        "../envs/vibroimpact.yaml"
    script:
        "../scripts/orbits.py"


rule verdicts:
    input:
        fixed_points="results/fixed_points/{case}.csv",
        orbits="results/orbits/{case}.csv",
    output:
        csv="results/verdicts/{case}.csv",
    params:
        system=lambda wildcards: system_of(wildcards.case),
        code=LIBRARY,
    log:
        "results/logs/verdicts/{case}.log",
    benchmark:
        "results/benchmarks/verdicts/{case}.tsv"
    conda:
        "../envs/vibroimpact.yaml"
    script:
        "../scripts/verdicts.py"


# The tables of all cases: fixed points with the verdicts on them, and orbits.
rule gather:
    input:
        fixed_points=expand("results/verdicts/{case}.csv", case=all_systems()),
        orbits=expand("results/orbits/{case}.csv", case=all_systems()),
    output:
        **in_report({"csv": "results/fixed_points.csv"}, "Tables"),
        orbits=report("results/orbits.csv", category="Tables", labels={"name": "orbits", "kind": "csv"}),
    params:
        code=LIBRARY,
    log:
        "results/logs/gather.log",
    benchmark:
        "results/benchmarks/gather.tsv"
    conda:
        "../envs/vibroimpact.yaml"
    script:
        "../scripts/gather.py"


rule proofs:
    input:
        orbits=expand("results/orbits/{case}.csv", case=all_systems()),
        searches=expand("results/orbits/{case}.search.json", case=all_systems()),
    output:
        json="results/proofs.json",
    params:
        systems=all_systems(),
        code=LIBRARY,
    log:
        "results/logs/proofs.log",
    benchmark:
        "results/benchmarks/proofs.tsv"
    conda:
        "../envs/vibroimpact.yaml"
    script:
        "../scripts/proofs.py"


# The theory's verdicts over a plane of forces, against exact orbits at several epsilon.
rule verdict_grid:
    output:
        **in_report({"csv": "results/verdict_grid.csv"}, "Tables"),
    params:
        system=config["system"] | {"f10_hat": 0.0, "f20_hat": 0.0},  # the grid has the forces
        settings=config["stability"]["verdict_grid"],
        code=LIBRARY,
    log:
        "results/logs/verdict_grid.log",
    benchmark:
        "results/benchmarks/verdict_grid.tsv"
    conda:
        "../envs/vibroimpact.yaml"
    script:
        "../scripts/verdict_grid.py"


# Measures of the regime of every case, and their Lyapunov spectra.
rule modulation:
    output:
        measures="results/regimes/modulation.csv",
        windows="results/regimes/modulation_windows.csv",
        spectra="results/regimes/spectra.csv",
    params:
        systems=all_systems(),
        settings=config["regimes"]["modulation"] | {"observation": config["regimes"]["observation"]},
        code=LIBRARY,
    log:
        "results/logs/modulation.log",
    benchmark:
        "results/benchmarks/modulation.tsv"
    conda:
        "../envs/vibroimpact.yaml"
    script:
        "../scripts/modulation.py"


# The verdicts on the fixed points of the cases as the balls get lighter.
rule verdicts_by_epsilon:
    output:
        csv="results/verdicts_by_epsilon.csv",
    params:
        systems=all_systems(),
        epsilon=config["stability"]["verdict_grid"]["epsilon"],
        code=LIBRARY,
    log:
        "results/logs/verdicts_by_epsilon.log",
    benchmark:
        "results/benchmarks/verdicts_by_epsilon.tsv"
    conda:
        "../envs/vibroimpact.yaml"
    script:
        "../scripts/verdicts_by_epsilon.py"


rule stability:
    input:
        rules.modulation.output,
        rules.gather.output,
        rules.proofs.output,
        rules.verdict_grid.output,
        rules.verdicts_by_epsilon.output,
