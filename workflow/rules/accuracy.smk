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


# For each figure the cheapest model that its lines cannot tell from the exact result.
MODELLED = {figure: scene for figure, scene in config["figures"].items() if "model" in scene}


rule scene_models:
    input:
        [path for figure in MODELLED for path in getattr(rules, figure).input if "results/" in path],
        expand("results/fixed_points/{case}.csv", case=all_systems()),
        expand(
            "results/orbits/{case}.csv",
            case={scene["case"] for scene in MODELLED.values() if scene["model"] == "simulation"},
        ),
        [f"results/figures/{figure}.csv" for figure in MODELLED],
    output:
        **in_report({"csv": "results/accuracy/scene_models.csv"}, "Accuracy and speed"),
    params:
        figures={
            figure: [scene, {name: getattr(rules, figure).params.get(name) for name in ("settings", "system")}]
            for figure, scene in MODELLED.items()
        },
        simulations={case: values["simulation"] for case, values in config["cases"].items()},
        seconds=ACCURACY["short_seconds"],
        code=code("scene_models", *(spec(figure)["module"] for figure in MODELLED)),
    threads: ALL_CORES
    log:
        "results/logs/accuracy/scene_models.log",
    benchmark:
        "results/benchmarks/accuracy/scene_models.tsv"
    conda:
        "../envs/vibroimpact.yaml"
    script:
        "../scripts/scene_models.py"


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
        rules.scene_models.output,
        rules.method_comparison.output,
