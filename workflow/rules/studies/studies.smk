# What goes beyond the chapter: `snakemake --cores 2 studies`. Deleting every folder and file called `studies` removes it.


include: "common.smk"
include: "stability.smk"
include: "sweeps.smk"
include: "figures.smk"
include: "claims.smk"
include: "report.smk"
include: "field.smk"


READ_BY_FIGURES = {path for figure in ALL_FIGURES for path in getattr(rules, figure).input if "results/" in path}
SIMULATED = {Path(path).parent.as_posix() for path in READ_BY_FIGURES if "results/simulations/" in path}


# What the columns of all tables mean, for programs that read them elsewhere.
rule datapackage:
    input:
        rules.index.input,
        rules.companions.input,
        rules.stability.input,
        rules.sweeps.input,
        sorted(READ_BY_FIGURES),
        expand("{run}/{table}.csv", run=sorted(SIMULATED), table=["samples", "events", "strobe"]),
        citation=own("CITATION.cff"),
        data=own("report/data.yaml"),
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
        rules.nudge.output,
        rules.datapackage.output,
