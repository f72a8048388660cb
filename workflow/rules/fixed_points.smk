# Fixed points of the slow flow, (10.23): one file per case.


rule fixed_points:
    output:
        csv="results/fixed_points/{case}.csv",
    params:
        system=lambda wildcards: system_of(wildcards.case),
        code=code("fixed_points"),
    priority: 10
    log:
        "results/logs/fixed_points/{case}.log",
    benchmark:
        "results/benchmarks/fixed_points/{case}.tsv"
    conda:
        "../envs/vibroimpact.yaml"
    script:
        "../scripts/fixed_points.py"
