# Is it stable? Exact 1:1 responses of each case, the verdict of every criterion on them and on the fixed points, what is
# proved of them, how complete both lists are. The tables of all cases feed no figure of the chapter.

# Tables of all cases, gathered from those of each: fixed points with the verdicts on them, and orbits.
GATHERED = {"fixed_points": "results/verdicts/{case}.csv", "orbits": "results/orbits/{case}.csv"}


rule orbits:
    output:
        csv="results/orbits/{case}.csv",
        search="results/orbits/{case}.search.json",
    params:
        system=lambda wildcards: system_of(wildcards.case),
        code=code("workflow/scripts/orbits.py"),
    log:
        "results/logs/orbits/{case}.log",
    benchmark:
        "results/benchmarks/orbits/{case}.tsv"
    script:
        "../scripts/orbits.py"


rule verdicts:
    input:
        fixed_points="results/fixed_points/{case}.csv",
        orbits="results/orbits/{case}.csv",
    output:
        "results/verdicts/{case}.csv",
    params:
        system=lambda wildcards: system_of(wildcards.case),
        code=code("workflow/scripts/verdicts.py"),
    log:
        "results/logs/verdicts/{case}.log",
    benchmark:
        "results/benchmarks/verdicts/{case}.tsv"
    script:
        "../scripts/verdicts.py"


for name, per_case in GATHERED.items():

    rule:
        name:
            f"gather_{name}"
        input:
            expand(per_case, case=all_systems()),
        output:
            **in_report({"csv": f"results/{name}.csv"}, "Tables"),
        params:
            code=code("workflow/scripts/gather.py"),
        log:
            f"results/logs/gather_{name}.log",
        benchmark:
            f"results/benchmarks/gather_{name}.tsv"
        script:
            "../scripts/gather.py"


rule proofs:
    input:
        tables=expand("results/orbits/{case}.csv", case=all_systems()),
        searches=expand("results/orbits/{case}.search.json", case=all_systems()),
    output:
        "results/proofs.json",
    params:
        systems=all_systems(),
        code=code("workflow/scripts/proofs.py"),
    log:
        "results/logs/proofs.log",
    benchmark:
        "results/benchmarks/proofs.tsv"
    script:
        "../scripts/proofs.py"


rule verdict_grid:
    output:
        **in_report({"csv": "results/verdict_grid.csv"}, "Tables"),
    params:
        system=next(iter(all_systems().values())),
        settings=config["stability"]["verdict_grid"],
        code=code("workflow/scripts/verdict_grid.py"),
    log:
        "results/logs/verdict_grid.log",
    benchmark:
        "results/benchmarks/verdict_grid.tsv"
    script:
        "../scripts/verdict_grid.py"


rule stability:
    input:
        [f"results/{name}.csv" for name in GATHERED],
        # What these are made of: if it is missing, Snakemake takes them as they are.
        [expand(rule.output, case=all_systems()) for rule in (rules.fixed_points, rules.orbits, rules.verdicts)],
        rules.proofs.output,
        rules.verdict_grid.output,
