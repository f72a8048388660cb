# How accurate and how fast each method is, and where it fails. A job that times things runs alone: it takes all cores.

TIMED = {"work_precision": (True, "short_seconds"), "work_precision_full": (False, "full_seconds")}
# Without a number of cores nothing is run: a summary, a graph, the report of Snakemake.
ALL_CORES = workflow.resource_settings.cores or 1
JUDGED = {"hazards": False, "hazards_full": True}
COMPARED = "every method, in float64, against a reference with enough digits that more would not change it"


def accuracy_outputs(name):
    return figure_files(f"results/accuracy/{name}")


def accuracy_problems():
    """Test problems of the chart with the parameters of their cases."""
    problems = config["accuracy"]["problems"]
    return {name: {"system": system_of(problem["case"]), "settings": problem} for name, problem in problems.items()}


def accuracy_provenance(name, seconds):
    problems = config["accuracy"]["problems"]
    cases = sorted({problem["case"] for problem in problems.values()})
    own = step(f"{COMPARED}; run times measured", DOUBLE, "workflow/scripts/work_precision.py")
    return provenance(name, ["accuracy.problems", f"accuracy.{seconds}"], cases, [own])


for name, (short, seconds) in TIMED.items():

    rule:
        name:
            name
        output:
            **in_report(accuracy_outputs(name), "Accuracy and speed"),
        params:
            problems=accuracy_problems(),
            seconds=config["accuracy"][seconds],
            short=short,
            provenance=accuracy_provenance(name, seconds),
        threads: ALL_CORES
        log:
            f"results/logs/accuracy/{name}.log",
        benchmark:
            f"results/benchmarks/accuracy/{name}.tsv"
        script:
            "../scripts/work_precision.py"


for name, all_of_them in JUDGED.items():

    rule:
        name:
            name
        output:
            **in_report(accuracy_outputs(name), "Accuracy and speed"),
        params:
            all_of_them=all_of_them,
            provenance=provenance(name, [], [], [step(COMPARED, DOUBLE, "workflow/scripts/hazards.py")]),
        log:
            f"results/logs/accuracy/{name}.log",
        benchmark:
            f"results/benchmarks/accuracy/{name}.tsv"
        script:
            "../scripts/hazards.py"


MODELLED = {figure: scene for figure, scene in config["figures"].items() if "model" in scene}


rule scene_models:
    input:
        [path for scene in MODELLED.values() for path in figure_inputs(scene).values()],
        expand(rules.orbits.output.csv, case=sorted(SIMULATED_CASES)),
        tables=[figure_outputs(figure, scene)["csv"] for figure, scene in MODELLED.items()],
    output:
        **in_report({"csv": "results/accuracy/scene_models.csv"}, "Accuracy and speed"),
    params:
        figures={figure: [scene, figure_settings(scene), drawn_by(figure, scene)] for figure, scene in MODELLED.items()},
        simulations={case: values["simulation"] for case, values in config["cases"].items()},
        seconds=config["accuracy"]["short_seconds"],
        code=code("workflow/scripts/scene_models.py", modules={drawn_by(*figure) for figure in MODELLED.items()}),
    threads: ALL_CORES
    log:
        "results/logs/accuracy/scene_models.log",
    benchmark:
        "results/benchmarks/accuracy/scene_models.tsv"
    script:
        "../scripts/scene_models.py"


rule accuracy:
    input:
        "results/accuracy/scene_models.csv",
        [path for name in ("work_precision", "hazards") for path in accuracy_outputs(name).values()],
