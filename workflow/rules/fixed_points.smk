# Fixed points of the slow flow, (10.23): one file per case. The table of all cases feeds no figure.


rule fixed_points:
    output:
        "results/fixed_points/{case}.csv",
    params:
        system=lambda wildcards: system_of(wildcards.case),
        code=code("workflow/scripts/fixed_points.py"),
    log:
        "results/logs/fixed_points/{case}.log",
    benchmark:
        "results/benchmarks/fixed_points/{case}.tsv"
    script:
        "../scripts/fixed_points.py"


rule gather_fixed_points:
    input:
        expand("results/fixed_points/{case}.csv", case=config["cases"]),
    output:
        "results/fixed_points.csv",
    params:
        code=code("workflow/scripts/gather.py"),
    log:
        "results/logs/gather_fixed_points.log",
    benchmark:
        "results/benchmarks/gather_fixed_points.tsv"
    script:
        "../scripts/gather.py"
