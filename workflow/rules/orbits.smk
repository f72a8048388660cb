# Exact 1:1 responses of each case, and the verdict of every criterion on them and on the fixed points.


rule orbits:
    output:
        csv="results/orbits/{case}.csv",
        search="results/orbits/{case}.search.json",
    params:
        system=lambda wildcards: system_of(wildcards.case),
        code=code("orbits"),
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
        code=code("verdicts"),
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
        code=code("gather"),
    log:
        "results/logs/gather.log",
    benchmark:
        "results/benchmarks/gather.tsv"
    conda:
        "../envs/vibroimpact.yaml"
    script:
        "../scripts/gather.py"
