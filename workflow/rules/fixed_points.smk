# Fixed points of the slow flow, (10.23): one file per case.


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
