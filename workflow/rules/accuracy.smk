# Measure accuracy, speed and failures of each method. A job that measures times claims all cores, so that no other job
# runs at the same time.

ACCURACY = config["accuracy"]
# Full effort means longer timings, and every method on every stress test.
FULL = ACCURACY["effort"] == "full"
# `cores` is None if Snakemake runs no jobs, for example when it makes a summary.
ALL_CORES = workflow.resource_settings.cores or 1


rule grazing:
    output:
        **files("grazing", "Accuracy and speed", folder="accuracy"),
    params:
        **chart("grazing"),
    priority: 30
    script:
        "../scripts/figure.py"


use rule grazing as stress_tests with:
    output:
        **files("stress_tests", "Accuracy and speed", folder="accuracy"),
    params:
        **chart("stress_tests", {"full": FULL}, {"accuracy.effort": ACCURACY["effort"]}),


use rule grazing as work_precision with:
    output:
        **files("work_precision", "Accuracy and speed", folder="accuracy"),
    params:
        **chart(
            "work_precision",
            {
                "problems": {
                    name: {"system": system_of(problem["case"]), **problem}
                    for name, problem in ACCURACY["problems"].items()
                },
                "seconds": ACCURACY["full_seconds" if FULL else "short_seconds"],
                "short": not FULL,
            },
            {f"accuracy.{name}": ACCURACY[name] for name in ("problems", "effort", "short_seconds", "full_seconds")}
            | {f"cases.{problem['case']}": system_of(problem["case"]) for problem in ACCURACY["problems"].values()},
        ),
    threads: ALL_CORES


# Figures whose config entry selects a model.
MODELLED = {figure: entry for figure, entry in config["figures"].items() if "model" in entry}


use rule grazing as models with:
    output:
        **files("models", "Accuracy and speed", folder="accuracy"),
    params:
        **chart(
            "models",
            {
                "scenes": {figure: modelled(figure, entry) for figure, entry in MODELLED.items()},
                "seconds": ACCURACY["short_seconds"],
            },
            {f"figures.{figure}": entry for figure, entry in MODELLED.items()}
            | {f"cases.{entry['case']}": config["cases"][entry["case"]] for entry in MODELLED.values()}
            | {"system": config["system"]},
            *(spec(figure)["module"] for figure in MODELLED),
        ),
    threads: ALL_CORES


rule method_comparison:
    input:
        work_precision="results/accuracy/work_precision.csv",
        stress_tests="results/accuracy/stress_tests.csv",
    output:
        **in_report({"csv": "results/accuracy/method_comparison.csv"}, "Accuracy and speed"),
        choices="results/accuracy/choices.csv",
    params:
        code=code("method_comparison"),
    script:
        "../scripts/method_comparison.py"


# The figure check compares these charts with the reference set, but ignores their run times.
CHARTS = "work_precision", "stress_tests", "grazing"
ALL_CHARTS = *CHARTS, "models"


rule accuracy:
    input:
        [getattr(rules, name).output for name in ALL_CHARTS],
        rules.method_comparison.output,
