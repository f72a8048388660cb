# Is it stable? Exact 1:1 responses of each case, the verdict of every criterion on them and on the fixed points, how
# complete both lists are. The tables of all cases feed no figure of the chapter.

STABILITY_FIGURES = "companion_10_04", "companion_10_05", "companion_stability"
# Cases whose direct integrations the claims are judged by.
CLAIMED_SIMULATIONS = ["equal", "weak"]
CLAIMS = "docs/claims.yaml"
GATHERED = {"fixed_points": "results/verdicts/{case}.csv", "orbits": "results/orbits/{case}.csv"}


rule orbits:
    output:
        "results/orbits/{case}.csv",
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
            **in_report({"csv": f"results/{name}.csv"}, "Tables", name),
        params:
            code=code("workflow/scripts/gather.py"),
        log:
            f"results/logs/gather_{name}.log",
        benchmark:
            f"results/benchmarks/gather_{name}.tsv"
        script:
            "../scripts/gather.py"


rule certificates:
    output:
        "results/certificates.json",
    params:
        systems=all_systems(),
        code=code("workflow/scripts/certificates.py"),
    log:
        "results/logs/certificates.log",
    benchmark:
        "results/benchmarks/certificates.tsv"
    script:
        "../scripts/certificates.py"


rule verdict_grid:
    output:
        **in_report({"csv": "results/verdict_grid.csv"}, "Tables", "verdict_grid"),
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
        rules.certificates.output,
        rules.verdict_grid.output,
        [path for name in STABILITY_FIGURES for path in companion_outputs(name).values()],


def claims_apply():
    """Whether the config has the chapter's parameters, which the claims are about."""
    chapter = yaml.safe_load((ROOT / CLAIMS).read_text(encoding="utf-8"))["parameters"]
    forced = all(values.items() <= config["cases"].get(case, {}).items() for case, values in chapter["cases"].items())
    return forced and chapter["system"] == config["system"]


# The chapter's claims: each verdict follows from the results of the stages before.
rule claims:
    input:
        claims=CLAIMS,
        fixed_points="results/fixed_points.csv",
        orbits="results/orbits.csv",
        certificates="results/certificates.json",
        verdict_grid="results/verdict_grid.csv",
        modulation="results/regimes/modulation.csv",
        special_points="results/regimes/special_points.csv",
        epsilon_orders="results/regimes/epsilon_orders.csv",
        **{
            f"{case}_{name.split('.')[0]}": f"results/simulations/{case}/{name}"
            for case in CLAIMED_SIMULATIONS
            for name in ("samples.csv", "events.csv", "summary.json")
        },
    output:
        **in_report({"json": "results/claims.json", "markdown": "results/claims.md"}, "Tables", "claims", ("json",)),
    params:
        systems=all_systems(),
        code=code("workflow/scripts/claims.py"),
    log:
        "results/logs/claims.log",
    benchmark:
        "results/benchmarks/claims.tsv"
    script:
        "../scripts/claims.py"
