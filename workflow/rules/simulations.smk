# Integrate (10.1) for each case and model (float64 or reference) that a figure shows.


rule simulation:
    output:
        samples="results/simulations/{case}/{model}/samples.csv",
        events="results/simulations/{case}/{model}/events.csv",
        summary="results/simulations/{case}/{model}/summary.json",
        strobe="results/simulations/{case}/{model}/strobe.csv",
    params:
        system=lambda wildcards: system_of(wildcards.case),
        settings=lambda wildcards: config["cases"][wildcards.case]["simulation"] | {"model": wildcards.model},
        code=code("simulate"),
    priority: 10
    script:
        "../scripts/simulate.py"
