# Report: an offline website and a PDF, built from the results of all stages.

MOVING = config["report"]
PICTURES = "png", "pdf", "svg"


for name, scene in MOVING["animations"].items():

    rule:
        name:
            name
        input:
            **{
                table: f"results/simulations/{scene['case']}/{arithmetic(scene)}/{table}.csv"
                for table in ("samples", "events")
            },
        output:
            **{kind: f"results/animations/{name}.{kind}" for kind in (*PICTURES, "json")},
        params:
            system=system_of(scene["case"]),
            cycles=scene["cycles"],
            code=code("studies/animation"),
        log:
            f"results/logs/report/{name}.log",
        conda:
            "../../envs/vibroimpact.yaml"
        script:
            "../../scripts/studies/animation.py"


rule force_sweep:
    output:
        **{kind: f"results/force_sweep/force_sweep.{kind}" for kind in ("csv", *PICTURES, "json")},
    params:
        system=system_of(MOVING["force_sweep"]["case"]),
        settings=MOVING["force_sweep"],
        code=code("studies/force_sweep"),
    log:
        "results/logs/report/force_sweep.log",
    conda:
        "../../envs/vibroimpact.yaml"
    script:
        "../../scripts/studies/force_sweep.py"


rule nudge:
    output:
        **{kind: f"results/nudge/nudge.{kind}" for kind in (*PICTURES, "json")},
    params:
        system=system_of(MOVING["force_sweep"]["case"]),
        code=code("studies/nudge"),
    log:
        "results/logs/report/nudge.log",
    conda:
        "../../envs/vibroimpact.yaml"
    script:
        "../../scripts/studies/nudge.py"


rule report:
    input:
        rules.figures.input,
        rules.companions.input,
        rules.stability.input,
        rules.accuracy.input,
        rules.claims.output,
        rules.force_sweep.output,
        rules.nudge.output,
        [f"results/animations/{name}.{kind}" for name in MOVING["animations"] for kind in (*PICTURES, "json")],
    output:
        site=directory("results/report"),
    params:
        figures=ALL_FIGURES,
        charts=ALL_CHARTS,
        tables=sorted(
            {table["file"] for one in ALL_FIGURES for name, table in spec(one)["tables"].items() if name != "csv"}
        ),
        config={name: config[name] for name in ("system", "cases", "figures", "report", "regimes", "stability")},
        code=code(
            "studies/report", "development.lock", "docs", "report", *(["src/vibroimpact"] if SRC.is_dir() else [])
        ),
    log:
        "results/logs/report/report.log",
    conda:
        "../../envs/vibroimpact.yaml"
    script:
        "../../scripts/studies/report.py"
