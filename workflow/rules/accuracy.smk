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
        module=module_of("work_precision"),
        settings={
            "problems": {
                name: {"system": system_of(problem["case"]), **problem}
                for name, problem in ACCURACY["problems"].items()
            },
            "seconds": ACCURACY["full_seconds" if FULL else "short_seconds"],
            "short": not FULL,
        },
        config={f"accuracy.{name}": ACCURACY[name] for name in ("problems", "effort", "short_seconds", "full_seconds")}
        | {f"cases.{problem['case']}": system_of(problem["case"]) for problem in ACCURACY["problems"].values()},
        code=code("figure", module_of("work_precision")),
    threads: ALL_CORES
    log:
        "results/logs/accuracy/work_precision.log",
    benchmark:
        "results/benchmarks/accuracy/work_precision.tsv"
    conda:
        "../envs/vibroimpact.yaml"
    script:
        "../scripts/figure.py"


rule stress_tests:
    output:
        **in_report(
            figure_files("results/accuracy/stress_tests", SPECS["stress_tests"]["tables"]), "Accuracy and speed"
        ),
    params:
        figure="stress_tests",
        module=module_of("stress_tests"),
        settings={"full": FULL},
        config={"accuracy.effort": ACCURACY["effort"]},
        code=code("figure", module_of("stress_tests")),
    priority: 30
    log:
        "results/logs/accuracy/stress_tests.log",
    benchmark:
        "results/benchmarks/accuracy/stress_tests.tsv"
    conda:
        "../envs/vibroimpact.yaml"
    script:
        "../scripts/figure.py"


rule grazing:
    output:
        **in_report(figure_files("results/accuracy/grazing", SPECS["grazing"]["tables"]), "Accuracy and speed"),
    params:
        figure="grazing",
        module=module_of("grazing"),
        settings={},
        config={},
        code=code("figure", module_of("grazing")),
    priority: 30
    log:
        "results/logs/accuracy/grazing.log",
    conda:
        "../envs/vibroimpact.yaml"
    script:
        "../scripts/figure.py"


# The figures that have a choice of models, and what each is computed from.
MODELLED = {figure: entry for figure, entry in config["figures"].items() if "model" in entry}


rule models:
    output:
        **in_report(figure_files("results/accuracy/models", SPECS["models"]["tables"]), "Accuracy and speed"),
    params:
        figure="models",
        module=module_of("models"),
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
    conda:
        "../envs/vibroimpact.yaml"
    script:
        "../scripts/figure.py"


rule method_comparison:
    input:
        work_precision="results/accuracy/work_precision.csv",
        stress_tests="results/accuracy/stress_tests.csv",
    output:
        **in_report({"csv": "results/accuracy/method_comparison.csv"}, "Accuracy and speed"),
        choices="results/accuracy/choices.csv",
    params:
        code=code("method_comparison"),
    log:
        "results/logs/accuracy/method_comparison.log",
    conda:
        "../envs/vibroimpact.yaml"
    script:
        "../scripts/method_comparison.py"


# The charts that are compared with a reference set: their errors, orders and failures, not their seconds.
CHARTS = "work_precision", "stress_tests", "grazing"


rule accuracy:
    input:
        [getattr(rules, name).output for name in CHARTS],
        rules.models.output,
        rules.method_comparison.output,
