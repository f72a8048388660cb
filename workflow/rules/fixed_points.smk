# Fixed points of the slow flow (10.23), exact 1:1 responses, and the verdicts of every criterion on both.


rule fixed_points:
    output:
        **in_report({"csv": "results/fixed_points.csv"}, "Tables"),
        orbits=report("results/orbits.csv", category="Tables", labels={"name": "orbits", "kind": "csv"}),
        search="results/orbits.search.json",
    params:
        systems=all_systems(),
        code=code("fixed_points"),
    priority: 20
    log:
        "results/logs/fixed_points.log",
    conda:
        "../envs/vibroimpact.yaml"
    script:
        "../scripts/fixed_points.py"
