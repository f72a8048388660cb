# One job per figure: its notebook, executed with the parameters of the figure. The rule bears the figure's name,
# so that `snakemake --cores 2 fig10_06` builds this figure and what it needs.

CASE_FILES = {
    "fixed_points": "results/fixed_points/{case}.csv",
    "verdicts": "results/verdicts/{case}.csv",
    "samples": "results/simulations/{case}/samples.csv",
    "events": "results/simulations/{case}/events.csv",
    "summary": "results/simulations/{case}/summary.json",
}
# What a figure is given to read is what its model needs, and for the line on what the exact system says; a drawing has none.
MODEL_INPUTS = {
    None: [],
    "closed_form": [],
    "slow_flow": ["fixed_points", "verdicts"],
    "simulation": ["fixed_points", "samples", "events", "summary"],
}
WITHOUT_TABLE = "drawings"


def simulated(scene):
    """Whether a figure shows a direct integration."""
    return scene.get("model") == "simulation"


SIMULATED_CASES = {scene["case"] for scene in config["figures"].values() if simulated(scene)}

# How a notebook makes a figure of them, for the record that goes with it.
METHODS = {
    "drawings": "drawn to scale, nothing computed",
    "closed_form": "closed form: (10.11), (10.16), (10.25), (10.26)",
    "fixed_points": "manifold in closed form, singular points as real zeros of (10.24)",
    "theoretical_response": "leading order, (10.9) and (10.10), at a fixed point",
    "simulation": "motion of the second module as simulated, with its events as corners",
    "physical_units": "direct integration of (10.1) from rest; linear systems in closed form",
}


def figure_inputs(scene):
    """Results of the figure's case that its notebook reads; without them it would compute them."""
    return {name: CASE_FILES[name].format(case=scene["case"]) for name in MODEL_INPUTS[scene.get("model")]}


def figure_outputs(figure, scene):
    files = figure_files(f"results/figures/{figure}", with_table=scene["notebook"] != WITHOUT_TABLE)
    if scene["notebook"] == "simulation" and exact(scene["case"]):
        files["statistics"] = f"results/figures/{figure}.statistics.csv"
    return files


def figure_settings(scene):
    """The figure's own slice of the config: its scene and the system parameters that it depends on."""
    used = scene.get("parameters", [])
    system = system_of(scene["case"]) if "case" in scene else {name: config["system"][name] for name in used}
    observed = (
        {"simulation": config["cases"][scene["case"]]["simulation"], "observation": config["regimes"]["observation"]}
        if simulated(scene)
        else {}
    )
    given = {name: value for name, value in scene.items() if name not in ("notebook", "model", "parameters")}
    return {**given, "system": system, **observed}


def drawn_by(figure, scene):
    """The module that draws a figure; those of one notebook share the module of a figure of the chapter."""
    shared = {
        "fixed_points": "chapter.fig10_06",
        "theoretical_response": "chapter.fig10_10" if "C_max" in scene else "chapter.fig10_07",
        "simulation": "chapter.fig10_08",
        "physical_units": "companions.physical_units",
    }
    return f"vibroimpact.figures.{shared.get(scene['notebook'], f'chapter.{figure}')}"


def figure_step(figure, scene):
    """How the figure itself is made."""
    files = "workflow/scripts/notebook.py", f"notebooks/{scene['notebook']}.ipynb"
    return step(METHODS[scene["notebook"]], DOUBLE, *files, modules=[drawn_by(figure, scene)])


def figure_provenance(figure, scene):
    """What decides on a figure: its scene, the parameters it depends on, the integration of its case if it shows that."""
    read = MODEL_INPUTS[scene.get("model")]
    cases = [scene["case"]] if "case" in scene else []
    keys = [f"figures.{figure}", *(f"system.{name}" for name in scene.get("parameters", []))]
    keys += [f"cases.{case}.simulation" for case in cases if simulated(scene)]
    keys += ["regimes.observation"] if simulated(scene) else []
    before = [step(*STEPS["fixed_points"])] if "fixed_points" in read else []
    before += [step(*STEPS[name]) for name in ("orbits", "verdicts")] if "verdicts" in read else []
    before += [simulation_step(scene["case"])] if simulated(scene) else []
    return provenance(figure, keys, cases, [*before, figure_step(figure, scene)])


for figure, scene in config["figures"].items():

    rule:
        name:
            figure
        input:
            **figure_inputs(scene),
        output:
            **in_report(figure_outputs(figure, scene), "Figures of the chapter"),
            html=f"results/notebooks/{figure}.html",
        params:
            notebook=f"notebooks/{scene['notebook']}.ipynb",
            alt=config["figure_texts"][figure]["alt"],
            title=config["figure_texts"][figure]["title"],
            settings=figure_settings(scene),
            provenance=figure_provenance(figure, scene),
        log:
            f"results/logs/figures/{figure}.log",
        benchmark:
            f"results/benchmarks/figures/{figure}.tsv"
        script:
            "../scripts/notebook.py"


rule figures:
    input:
        [f"results/notebooks/{figure}.html" for figure in config["figures"]],
        [path for figure, scene in config["figures"].items() for path in figure_outputs(figure, scene).values()],
        # All outputs of a simulation, read or not: if one of them is missing, Snakemake takes the others as they are.
        expand(rules.simulation.output, case=sorted(SIMULATED_CASES)),
