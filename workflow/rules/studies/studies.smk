# Studies beyond the chapter: `snakemake --cores 2 studies`. To remove the studies, delete all folders and files named
# `studies`.


include: "stability.smk"
include: "sweeps.smk"
include: "claims.smk"
include: "report.smk"


READ_BY_FIGURES = {path for figure in ALL_FIGURES for path in getattr(rules, figure).input if "results/" in path}
SIMULATED = {Path(path).parent.as_posix() for path in READ_BY_FIGURES if "results/simulations/" in path}


# Machine-readable description of all columns in all tables.
rule datapackage:
    input:
        rules.index.input,
        rules.companions.input,
        rules.stability.input,
        rules.sweeps.input,
        sorted(READ_BY_FIGURES),
        expand("{run}/{table}.csv", run=sorted(SIMULATED), table=["samples", "events", "strobe"]),
        citation=checkout_path("CITATION.cff"),
        data=checkout_path("report/data.yaml"),
    output:
        json="results/datapackage.json",
    params:
        figures=SCENES,
        code=code("studies/datapackage", "report/data.yaml", "CITATION.cff", *map(module_of, SPECS)),
    log:
        "results/logs/datapackage.log",
    conda:
        "../../envs/vibroimpact.yaml"
    script:
        "../../scripts/studies/datapackage.py"


rule studies:
    input:
        rules.companions.input,
        rules.stability.input,
        rules.claims.output,
        rules.sweeps.input,
        rules.datapackage.output,
