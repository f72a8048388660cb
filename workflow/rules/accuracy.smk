# How accurate and how fast each method is, and where it fails. A job that times things runs alone: it takes all cores.
# `accuracy: {effort: full}` in the config repeats every timing for longer, and tries every method on every stress test.

ACCURACY = config["accuracy"]
FULL = ACCURACY["effort"] == "full"
# Without a number of cores nothing is run: a summary, a graph, the report of Snakemake.
ALL_CORES = workflow.resource_settings.cores or 1


rule work_precision:
    output:
        **in_report(
            figure_files("results/accuracy/work_precision", SPECS["work_precision"]["tables"]), "Accuracy and speed"
        ),
    params:
        figure="work_precision",
        problems={
            name: {"system": system_of(problem["case"]), **problem} for name, problem in ACCURACY["problems"].items()
        },
        seconds=ACCURACY["full_seconds" if FULL else "short_seconds"],
        short=not FULL,
        config={f"accuracy.{name}": ACCURACY[name] for name in ("problems", "effort", "short_seconds", "full_seconds")}
        | {f"cases.{problem['case']}": system_of(problem["case"]) for problem in ACCURACY["problems"].values()},
        code=code("work_precision"),
    threads: ALL_CORES
    log:
        "results/logs/accuracy/work_precision.log",
    benchmark:
        "results/benchmarks/accuracy/work_precision.tsv"
    conda:
        "../envs/vibroimpact.yaml"
    script:
        "../scripts/work_precision.py"


rule hazards:
    output:
        **in_report(figure_files("results/accuracy/hazards", SPECS["hazards"]["tables"]), "Accuracy and speed"),
    params:
        figure="hazards",
        full=FULL,
        config={"accuracy.effort": ACCURACY["effort"]},
        code=code("hazards"),
    log:
        "results/logs/accuracy/hazards.log",
    benchmark:
        "results/benchmarks/accuracy/hazards.tsv"
    conda:
        "../envs/vibroimpact.yaml"
    script:
        "../scripts/hazards.py"


# The figures that have a choice of models, and what each is computed from.
MODELLED = {figure: entry for figure, entry in config["figures"].items() if "model" in entry}


rule models:
    output:
        **in_report(figure_files("results/accuracy/models", SPECS["models"]["tables"]), "Accuracy and speed"),
    params:
        figure="models",
        settings={
            "scenes": {figure: modelled(figure, entry) for figure, entry in MODELLED.items()},
            "seconds": ACCURACY["short_seconds"],
        },
        config={f"figures.{figure}": entry for figure, entry in MODELLED.items()}
        | {f"cases.{entry['case']}": config["cases"][entry["case"]] for entry in MODELLED.values()}
        | {"system": config["system"]},
        code=code("figure", module_of("models"), *(spec(figure)["module"] for figure in MODELLED)),
    threads: ALL_CORES
    log:
        "results/logs/accuracy/models.log",
    benchmark:
        "results/benchmarks/accuracy/models.tsv"
    conda:
        "../envs/vibroimpact.yaml"
    script:
        "../scripts/figure.py"


rule method_comparison:
    input:
        work_precision="results/accuracy/work_precision.csv",
        hazards="results/accuracy/hazards.csv",
    output:
        **in_report({"csv": "results/accuracy/method_comparison.csv"}, "Accuracy and speed"),
    params:
        code=code("method_comparison"),
    log:
        "results/logs/accuracy/method_comparison.log",
    benchmark:
        "results/benchmarks/accuracy/method_comparison.tsv"
    conda:
        "../envs/vibroimpact.yaml"
    script:
        "../scripts/method_comparison.py"


rule accuracy:
    input:
        rules.work_precision.output,
        rules.hazards.output,
        rules.models.output,
        rules.method_comparison.output,
