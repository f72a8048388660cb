# Direct integration of (10.1): one directory per case that a figure shows.


rule simulation:
    output:
        samples="results/simulations/{case}/samples.csv",
        events="results/simulations/{case}/events.csv",
        summary="results/simulations/{case}/summary.json",
        strobe="results/simulations/{case}/strobe.csv",
    params:
        system=lambda wildcards: system_of(wildcards.case),
        settings=lambda wildcards: config["cases"][wildcards.case]["simulation"],
        code=code("workflow/scripts/simulate.py"),
    log:
        "results/logs/simulations/{case}.log",
    benchmark:
        "results/benchmarks/simulations/{case}.tsv"
    script:
        "../scripts/simulate.py"


PRECISE = [case for case, scene in config["cases"].items() if "digits" in scene["simulation"]]


rule companion_horizon:
    input:
        strobe=f"results/simulations/{PRECISE[0]}/strobe.csv" if PRECISE else [],
    output:
        **in_report(
            {kind: f"results/figures/companion_horizon.{kind}" for kind in ("png", "pdf", "svg", "csv")},
            "Companion figures",
            "companion_horizon",
        ),
    params:
        system=system_of(PRECISE[0]) if PRECISE else {},
        settings=config["cases"][PRECISE[0]]["simulation"] if PRECISE else {},
        code=code("workflow/scripts/horizon.py"),
    log:
        "results/logs/companion_horizon.log",
    benchmark:
        "results/benchmarks/companion_horizon.tsv"
    script:
        "../scripts/horizon.py"
