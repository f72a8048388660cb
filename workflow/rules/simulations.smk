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
        code=code("simulate"),
    priority: 10
    log:
        "results/logs/simulations/{case}.log",
    benchmark:
        "results/benchmarks/simulations/{case}.tsv"
    conda:
        "../envs/vibroimpact.yaml"
    script:
        "../scripts/simulate.py"
