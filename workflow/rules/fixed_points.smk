# Compute fixed points of the slow flow (10.23) and exact 1:1 responses of each case. A 1:1 response has one impact at
# each wall per forcing period.


rule fixed_points:
    output:
        points="results/fixed_points/{case}.csv",
        orbits="results/orbits/{case}.csv",
        search="results/orbits/{case}.search.json",
    params:
        system=lambda wildcards: system_of(wildcards.case),
        code=code("fixed_points"),
    priority: 20
    script:
        "../scripts/fixed_points.py"


# Join the tables of all cases.
rule gather:
    input:
        points=expand("results/fixed_points/{case}.csv", case=all_systems()),
        orbits=expand("results/orbits/{case}.csv", case=all_systems()),
    output:
        **in_report({"csv": "results/fixed_points.csv"}, "Tables"),
        orbits=report("results/orbits.csv", category="Tables", labels={"name": "orbits", "kind": "csv"}),
    params:
        code=code("gather"),
    script:
        "../scripts/gather.py"
